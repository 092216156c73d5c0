//! Values on the command line that carry a unit or a form of their own.

use std::time::Duration;

use steradian::geometry::{Direction, Point, Vector};
use steradian::quantity::{Angle, Time};

/// `1%` or `0.01`.
pub fn ratio(text: &str) -> Result<f64, String> {
    let (number, scale) = text
        .strip_suffix('%')
        .map_or((text, 1.0), |number| (number, 0.01));
    match number.trim().parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number * scale),
        _ => Err("expected a positive ratio such as 1% or 0.01".to_owned()),
    }
}

/// `30s`, `5 min`.
pub fn duration(text: &str) -> Result<Duration, String> {
    let time: Time = text.parse().map_err(|error| format!("{error}"))?;
    Duration::try_from_secs_f64(time.to_seconds())
        .ok()
        .filter(|time| !time.is_zero())
        .ok_or_else(|| "expected a positive time such as 30s or 5min".to_owned())
}

/// `4096` or `1e6`.
pub fn count(text: &str) -> Result<u64, String> {
    let number = text.parse::<f64>().unwrap_or(f64::NAN);
    if number >= 1.0 && number <= 2_f64.powi(53) && number.fract() == 0.0 {
        return Ok(number as u64);
    }
    Err("expected a positive whole number such as 4096 or 1e6".to_owned())
}

/// `2/3`: part 2 of 3.
pub fn shard(text: &str) -> Result<(u32, u32), String> {
    let parts = text
        .split_once('/')
        .and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
    match parts {
        Some((k, n)) if (1..=n).contains(&k) => Ok((k, n)),
        _ => Err("expected a part and the number of parts such as 2/3".to_owned()),
    }
}

/// `640x480`.
pub fn resolution(text: &str) -> Result<[u32; 2], String> {
    let parts = text
        .split_once(['x', '×'])
        .and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    match parts {
        Some([width, height]) if width > 0 && height > 0 => Ok([width, height]),
        _ => Err("expected a width and a height in pixels such as 640x480".to_owned()),
    }
}

/// `x,y,z`.
pub fn vector(text: &str) -> Result<[f64; 3], String> {
    numbers(text).map_err(|_| "expected three numbers such as 0,0,1".to_owned())
}

/// `x,y,z` as a place.
pub fn point(text: &str) -> Result<Point, String> {
    vector(text).map(Point::from)
}

/// `x,y,z` of any length as a direction.
pub fn direction(text: &str) -> Result<Direction, String> {
    Direction::new(Vector::from(vector(text)?)).map_err(|error| error.to_string())
}

/// Finite numbers, so many of them: `0,0,2,1`.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>())
        .collect();
    let numbers = numbers
        .ok()
        .filter(|numbers| numbers.iter().all(|number| number.is_finite()));
    numbers
        .and_then(|numbers| <[f64; N]>::try_from(numbers).ok())
        .ok_or_else(|| format!("expected {N} numbers with commas between them"))
}

/// Places in a row.
#[derive(Clone, Debug)]
pub struct Points(pub Vec<Point>);

/// `x,y,z x,y,z …`.
pub fn points(text: &str) -> Result<Points, String> {
    let points: Result<Vec<Point>, String> = text.split_whitespace().map(point).collect();
    points.map(Points)
}

/// `0:90deg`: two angles; the first has the unit of the second if it has none.
pub fn angles(text: &str) -> Result<[Angle; 2], String> {
    let (from, to) = text
        .split_once(':')
        .ok_or("expected two angles such as 0:90deg")?;
    let unit = to
        .trim()
        .trim_start_matches(|c: char| c.is_ascii_digit() || "+-.eE ".contains(c));
    let from = if from.trim().parse::<f64>().is_ok() {
        format!("{from}{unit}")
    } else {
        from.to_owned()
    };
    let angle = |text: &str| text.parse::<Angle>().map_err(|error| error.to_string());
    Ok([angle(&from)?, angle(to)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_values_are_read() {
        assert!((ratio("1%").unwrap() - 0.01).abs() < 1e-15);
        assert_eq!(ratio("0.05"), Ok(0.05));
        assert_eq!(duration("1.5min"), Ok(Duration::from_secs(90)));
        assert_eq!(count("1e6"), Ok(1_000_000));
        assert_eq!(shard("2/3"), Ok((2, 3)));
        assert_eq!(resolution("640x480"), Ok([640, 480]));
        assert_eq!(vector("0, -1,2.5"), Ok([0.0, -1.0, 2.5]));
        assert_eq!(numbers("1, -2"), Ok([1.0, -2.0]));
        assert_eq!(
            points("0,0,1  2,3,4").unwrap().0,
            [Point::new(0.0, 0.0, 1.0), Point::new(2.0, 3.0, 4.0)]
        );
        let right = [Angle::ZERO, Angle::QUARTER_TURN];
        assert_eq!(
            [angles("0:90deg"), angles("0 deg:90 deg")],
            [Ok(right), Ok(right)]
        );
    }

    #[test]
    fn bad_values_say_what_was_expected() {
        for error in [
            ratio("-1%").unwrap_err(),
            ratio("nan").unwrap_err(),
            duration("-5s").unwrap_err(),
            duration("5").unwrap_err(),
            duration("5 kg").unwrap_err(),
            count("0").unwrap_err(),
            count("1.5").unwrap_err(),
            shard("4/3").unwrap_err(),
            shard("0/3").unwrap_err(),
            resolution("0x5").unwrap_err(),
            vector("1,2").unwrap_err(),
            vector("1,2,inf").unwrap_err(),
            numbers::<2>("1,2,3").unwrap_err(),
            points("0,0,1 2,3").unwrap_err(),
            angles("90deg").unwrap_err(),
            angles("0:90").unwrap_err(),
        ] {
            assert!(error.contains("expected"), "{error}");
        }
    }
}
