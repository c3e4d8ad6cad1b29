//! Differences of doubles from answers of many digits, without a rounding before the difference is taken.

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// 2π to 60 digits: no difference that counts here is smaller.
const TURN: &str = "6.28318530717958647692528676655900576839433879875021164194989";

/// A decimal as it is written: `-1.25e-3`.
pub(crate) fn decimal(text: &str) -> Result<RBig, String> {
    let wrong = || format!("`{text}` is not a number");
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: IBig = format!("{whole}{fraction}").parse().map_err(|_| wrong())?;
    let exponent: i64 = exponent.trim_start_matches('+').parse().map_err(|_| wrong())?;
    let shift = exponent - i64::try_from(fraction.len()).map_err(|_| wrong())?;
    let size = usize::try_from(shift.unsigned_abs()).ok().filter(|size| *size < 10_000).ok_or_else(wrong)?;
    let power = UBig::from(10u8).pow(size);
    Ok(if shift < 0 { RBig::from_parts(digits, power) } else { RBig::from(digits * IBig::from(power)) })
}

/// How far a double is from an answer; infinite if it is no number.
pub(crate) fn difference(own: f64, answer: &str) -> Result<f64, String> {
    let answer = decimal(answer)?;
    Ok(RBig::try_from(own).map_or(f64::INFINITY, |own| (own - answer).to_f64().value()))
}

/// The same of angles, whole turns aside.
pub(crate) fn difference_of_angles(own: f64, answer: &str) -> Result<f64, String> {
    let answer = decimal(answer)?;
    let Ok(own) = RBig::try_from(own) else { return Ok(f64::INFINITY) };
    let (difference, turn) = (own - answer, decimal(TURN)?);
    let turns = (&difference / &turn).round();
    Ok((difference - turn * RBig::from(turns)).to_f64().value())
}

/// An answer as a double, where only its size counts.
pub(crate) fn nearest(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("`{text}` is not a number"))
}

#[cfg(test)]
mod tests {
    use super::{difference, difference_of_angles};

    #[test]
    fn differences_are_exact() {
        let close = |found: Result<f64, String>, expected: f64| {
            let found = found.expect("a number");
            assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        };
        close(difference(0.1, "1e-1"), 5.551_115_123_125_783e-18);
        close(difference(-2e10, "-1.99999999999999999999e+10"), -1e-10);
        let turned = difference_of_angles(0.5, "13.0663706143591729538505735331180115367886775975");
        assert!(turned.is_ok_and(|difference| difference.abs() < 1e-45));
        assert_eq!(difference(0.0, "0"), Ok(0.0));
        assert_eq!(difference(f64::NAN, "0"), Ok(f64::INFINITY));
        for wrong in ["", "x", "1.2.3", "1e", "--1"] {
            assert!(difference(0.0, wrong).is_err(), "{wrong}");
        }
    }
}
