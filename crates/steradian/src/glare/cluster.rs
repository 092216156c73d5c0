//! Bright pixels put together: those that touch, and those within an angle of one another, directly or by way of others.

use std::collections::BTreeMap;

use crate::geometry::Direction;

/// Groups of the pixels of a picture of this width for which `direction` is not `None`, in the order of their first pixels.
///
/// Pixels are of one group if they are neighbours, also diagonally, or if the angle between them is at most `reach` in rad.
pub(super) fn clusters(
    width: usize,
    members: &[usize],
    direction: impl Fn(usize) -> Direction,
    reach: f64,
) -> Vec<Vec<usize>> {
    let mut union = Union::new(members.len());
    join_neighbours(width, members, &mut union);
    join_near(members, &direction, reach, &mut union);
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, &pixel) in members.iter().enumerate() {
        groups.entry(union.root(index)).or_default().push(pixel);
    }
    groups.into_values().collect()
}

/// `members` increase, so that the neighbours before a pixel are found by bisection.
fn join_neighbours(width: usize, members: &[usize], union: &mut Union) {
    for (index, &pixel) in members.iter().enumerate() {
        let column = pixel % width;
        let before = [
            (column > 0, 1),
            (column > 0, width + 1),
            (true, width),
            (column + 1 < width, width - 1),
        ];
        for (exists, step) in before {
            let neighbour = pixel.checked_sub(step).filter(|_| exists && step > 0);
            let found = neighbour.and_then(|pixel| members[..index].binary_search(&pixel).ok());
            if let Some(other) = found {
                union.join(index, other);
            }
        }
    }
}

/// Cells of space are so small that all directions in one are within reach of each other.
fn join_near(
    members: &[usize],
    direction: &impl Fn(usize) -> Direction,
    reach: f64,
    union: &mut Union,
) {
    let chord = 2.0 * libm::sin(0.5 * reach);
    let side = chord / 3.0_f64.sqrt();
    if side <= 0.0 {
        return;
    }
    let place = |index: usize| direction(members[index]).to_vector();
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for index in 0..members.len() {
        let cell = place(index).to_array().map(|x| (x / side).floor() as i64);
        let cell = cells.entry(cell).or_default();
        if let Some(&first) = cell.first() {
            union.join(first, index);
        }
        cell.push(index);
    }
    let is_near = |a: usize, b: usize| (place(a) - place(b)).length_squared() <= chord * chord;
    for (cell, here) in &cells {
        for step in STEPS_AHEAD {
            let other = [0, 1, 2].map(|axis| cell[axis] + step[axis]);
            let Some(there) = cells.get(&other) else {
                continue;
            };
            let apart = union.root(here[0]) != union.root(there[0]);
            if apart && here.iter().any(|&a| there.iter().any(|&b| is_near(a, b))) {
                union.join(here[0], there[0]);
            }
        }
    }
}

/// Steps of up to two cells, one of each opposite pair.
const STEPS_AHEAD: [[i64; 3]; 62] = {
    let mut steps = [[0; 3]; 62];
    let (mut count, mut code) = (0, 63);
    while code < 125 {
        steps[count] = [code / 25 - 2, code / 5 % 5 - 2, code % 5 - 2];
        count += 1;
        code += 1;
    }
    steps
};

/// Disjoint sets; the root of each is its first member.
struct Union(Vec<usize>);

impl Union {
    fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    fn root(&mut self, mut index: usize) -> usize {
        while self.0[index] != index {
            self.0[index] = self.0[self.0[index]];
            index = self.0[index];
        }
        index
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A picture 40 pixels wide, each .01 rad.
    fn looking(pixel: usize) -> Direction {
        let (x, y) = ((pixel % 40) as f64, (pixel / 40) as f64);
        Direction::new([1.0, 0.01 * x, 0.01 * y].into()).unwrap()
    }

    #[test]
    fn what_is_near_goes_together() {
        let members = [0, 1, 5, 20, 41, 200];
        let groups = clusters(40, &members, looking, 0.045);
        assert_eq!(groups, [vec![0, 1, 5, 41, 200], vec![20]]);
        assert_eq!(clusters(40, &members, looking, 0.0).len(), 4);
        assert_eq!(clusters(40, &members, looking, 0.2).len(), 1);
    }

    proptest! {
        /// The same groups as by comparing every pixel with every other.
        #[test]
        fn groups_are_those_of_all_pairs(
            set in prop::collection::btree_set(0_usize..1600, 0..60), reach in 0.011..0.1_f64,
        ) {
            let members: Vec<usize> = set.into_iter().collect();
            let mut union = Union::new(members.len());
            for a in 0..members.len() {
                for b in 0..a {
                    let [p, q] = [a, b].map(|index| looking(members[index]).to_vector());
                    let touches = (members[a] / 40).abs_diff(members[b] / 40) <= 1
                        && (members[a] % 40).abs_diff(members[b] % 40) <= 1;
                    if touches || (p - q).length() <= 2.0 * libm::sin(0.5 * reach) {
                        union.join(a, b);
                    }
                }
            }
            let roots: std::collections::BTreeSet<usize> = (0..members.len()).map(|index| union.root(index)).collect();
            let groups = clusters(40, &members, looking, reach);
            prop_assert_eq!(groups.len(), roots.len());
            prop_assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), members.len());
        }
    }
}
