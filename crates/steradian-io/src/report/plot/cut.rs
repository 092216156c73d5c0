//! Lines cut at the edges of the unit square (Liang & Barsky, ACM Trans. Graphics 3 (1), 1984).

/// The part of a segment inside the unit square; none of one that only touches it.
pub fn inside([from, to]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let step = [to[0] - from[0], to[1] - from[1]];
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        for (speed, room) in [(-step[axis], from[axis]), (step[axis], 1.0 - from[axis])] {
            if speed > 0.0 {
                leave = leave.min(room / speed);
            } else if speed < 0.0 {
                enter = enter.max(room / speed);
            } else if room < 0.0 {
                return None;
            }
        }
    }
    let at = |t: f64| [from[0] + t * step[0], from[1] + t * step[1]];
    let end = if leave < 1.0 { at(leave) } else { to };
    (enter < leave).then(|| [at(enter), end])
}

/// The parts of a line through points that are inside the unit square.
pub fn runs_inside(points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    for edge in points.windows(2) {
        let Some([from, to]) = inside([edge[0], edge[1]]) else {
            continue;
        };
        match runs.last_mut() {
            Some(run) if run.last() == Some(&from) => run.push(to),
            _ => runs.push(vec![from, to]),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_line_out_of_the_square_and_back_falls_apart() {
        let line = [[0.25, 0.5], [0.5, 1.5], [0.75, 0.5], [0.75, 0.25]];
        let runs = runs_inside(&line);
        assert_eq!(
            runs,
            [
                vec![[0.25, 0.5], [0.375, 1.0]],
                vec![[0.625, 1.0], [0.75, 0.5], [0.75, 0.25]]
            ]
        );
        assert!(runs_inside(&[[2.0, 0.0], [2.0, 1.0]]).is_empty());
        assert!(runs_inside(&[[0.5, 0.5]]).is_empty());
    }

    proptest! {
        #[test]
        fn what_is_left_is_inside_and_on_the_segment(ends in prop::array::uniform4(-2.0..3.0_f64), t in 0.0..1.0_f64) {
            let [from, to] = [[ends[0], ends[1]], [ends[2], ends[3]]];
            let is_inside = |p: [f64; 2], slack: f64| p.iter().all(|x| (-slack..=1.0 + slack).contains(x));
            let point = [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
            match inside([from, to]) {
                None => prop_assert!(!is_inside(point, -1e-12)),
                Some(part) => for end in part {
                    let area = (end[0] - from[0]) * (to[1] - from[1]) - (end[1] - from[1]) * (to[0] - from[0]);
                    prop_assert!(is_inside(end, 1e-12) && area.abs() < 1e-11);
                },
            }
        }
    }
}
