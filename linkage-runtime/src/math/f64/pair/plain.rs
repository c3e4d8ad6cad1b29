//! In sums and products that are rounded one by one.

use core::arch::x86_64::{
    __m128d, _mm_add_pd, _mm_and_pd, _mm_andnot_pd, _mm_cvtsd_f64, _mm_mul_pd, _mm_or_pd, _mm_set1_pd, _mm_shuffle_pd,
    _mm_sub_pd, _mm_xor_pd,
};

use super::super::sin_cos::{COSINE, FRAC_PI_2, ROUND, Reduced, SINE};
use super::{Halves, QUADRANTS, SIGN, Spread, both, row, twice};

ways_in!("sse2");

/// As in `reduce`.
#[inline]
#[target_feature(enable = "sse2")]
fn rounded(x: __m128d, turns: f64) -> __m128d {
    _mm_add_pd(_mm_mul_pd(x, _mm_set1_pd(turns)), _mm_set1_pd(ROUND))
}

/// As in the function of this name for one number.
#[inline]
#[target_feature(enable = "sse2")]
fn reduced(x: __m128d, rounded: __m128d) -> Spread {
    let [high, middle, low] = FRAC_PI_2.map(|part| _mm_set1_pd(part));
    let n = _mm_sub_pd(rounded, _mm_set1_pd(ROUND));
    let x1 = _mm_sub_pd(x, _mm_mul_pd(n, high));
    let w = _mm_mul_pd(n, middle);
    let y = _mm_sub_pd(x1, w);
    let t = _mm_sub_pd(_mm_mul_pd(n, low), _mm_sub_pd(_mm_sub_pd(x1, y), w));
    Spread { quadrant: _mm_cvtsd_f64(rounded).to_bits(), y, t }
}

/// Both halves are own − (z · first · polynomial + tail): of a sine own is y, of a cosine 1 − z/2, whose rounding goes into the tail. The own
/// term of each half is the derivative of the other, and so the factor of its tail: (sin, cos)' = (cos, −sin).
#[inline]
#[target_feature(enable = "sse2")]
fn sin_cos(Spread { quadrant, y, t }: Spread) -> (f64, f64) {
    let turn = row(&TURNS, quadrant);
    let z = _mm_mul_pd(y, y);
    let z2 = _mm_mul_pd(z, z);
    let [k0, k1, k2, k3, k4, k5] = turn.coefficients.each_ref().map(|of| of.bits());
    let p0 = _mm_add_pd(k0, _mm_mul_pd(z, k1));
    let p1 = _mm_add_pd(k2, _mm_mul_pd(z, k3));
    let p2 = _mm_add_pd(k4, _mm_mul_pd(z, k5));
    let p = _mm_add_pd(_mm_add_pd(p0, _mm_mul_pd(z2, p1)), _mm_mul_pd(_mm_mul_pd(z2, z2), p2));

    let is_sine = turn.is_sine.bits();
    let first = _mm_or_pd(_mm_and_pd(is_sine, y), _mm_andnot_pd(is_sine, z));
    let start = _mm_xor_pd(_mm_and_pd(is_sine, y), turn.at_zero.bits());
    let half = _mm_mul_pd(z, turn.half.bits());
    let own = _mm_sub_pd(start, half);
    let lost = _mm_sub_pd(half, _mm_sub_pd(start, own));
    let derivative = _mm_xor_pd(_mm_shuffle_pd::<1>(own, own), Halves([0, SIGN]).bits());
    let tail = _mm_add_pd(lost, _mm_mul_pd(t, derivative));
    both(_mm_sub_pd(own, _mm_add_pd(_mm_mul_pd(_mm_mul_pd(z, first), p), tail)))
}

/// What a quadrant makes of the halves. From a table, because what is read takes none of the units that calculate.
struct Turn {
    /// Those of S or −C, negated where the half is.
    coefficients: [Halves; 6],
    /// All bits of a half that is ± the sine of the reduced angle, none of one that is ± its cosine.
    is_sine: Halves,
    /// ±0 for a sine, whose sign that of y is multiplied by, ±1 for a cosine.
    at_zero: Halves,
    /// 0 for a sine, ±½ for a cosine.
    half: Halves,
}

static TURNS: [Turn; 4] =
    [Turn::of(QUADRANTS[0]), Turn::of(QUADRANTS[1]), Turn::of(QUADRANTS[2]), Turn::of(QUADRANTS[3])];

impl Turn {
    const fn of(halves: [(bool, bool); 2]) -> Self {
        const ZERO: Halves = Halves::ZERO;
        let mut turn = Self { coefficients: [ZERO; 6], is_sine: ZERO, at_zero: ZERO, half: ZERO };
        let mut half = 0;
        while half < 2 {
            let (is_sine, negated) = halves[half];
            let one = if negated { -1.0 } else { 1.0 };
            let mut term = 0;
            while term < 6 {
                turn.coefficients[term].0[half] = (one * if is_sine { SINE[term] } else { -COSINE[term] }).to_bits();
                term += 1;
            }
            turn.is_sine.0[half] = if is_sine { u64::MAX } else { 0 };
            turn.at_zero.0[half] = (one * if is_sine { 0.0 } else { 1.0 }).to_bits();
            turn.half.0[half] = if is_sine { 0.0 } else { 0.5 * one }.to_bits();
            half += 1;
        }
        turn
    }
}
