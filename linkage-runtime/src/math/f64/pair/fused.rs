//! In fused operations.

use core::arch::x86_64::{
    __m128d, _mm_cvtsd_f64, _mm_fmadd_pd, _mm_fnmadd_pd, _mm_mul_pd, _mm_set1_pd, _mm_sub_pd, _mm_xor_pd,
};

use super::super::fused::{COSINE, FRAC_PI_2, SINE};
use super::super::sin_cos::{ROUND, Reduced};
use super::{Halves, QUADRANTS, SIGN, Spread, both, row, twice};

ways_in!("sse2,fma");

/// As in `reduce`.
#[inline]
#[target_feature(enable = "sse2,fma")]
fn rounded(x: __m128d, turns: f64) -> __m128d {
    _mm_fmadd_pd(x, _mm_set1_pd(turns), _mm_set1_pd(ROUND))
}

/// As in the function of this name for one number.
#[inline]
#[target_feature(enable = "sse2,fma")]
fn reduced(x: __m128d, rounded: __m128d) -> Spread {
    let [high, middle, low] = FRAC_PI_2.map(|part| _mm_set1_pd(part));
    let n = _mm_sub_pd(rounded, _mm_set1_pd(ROUND));
    let x1 = _mm_fnmadd_pd(n, high, x);
    let w = _mm_mul_pd(n, middle);
    let y = _mm_sub_pd(x1, w);
    let t = _mm_fmadd_pd(n, low, _mm_sub_pd(w, _mm_sub_pd(x1, y)));
    Spread { quadrant: _mm_cvtsd_f64(rounded).to_bits(), y, t }
}

/// Both halves are own − other · (y³ · polynomial + tail): y − (y³S + t), or 1 − y ((y/2 − t) − y³C).
#[inline]
#[target_feature(enable = "sse2,fma")]
fn sin_cos(Spread { quadrant, y, t }: Spread) -> (f64, f64) {
    let turn = row(&TURNS, quadrant);
    let z = _mm_mul_pd(y, y);
    let (z2, y3) = (_mm_mul_pd(z, z), _mm_mul_pd(y, z));
    let [c0, c1, c2, c3, c4, c5] = turn.coefficients.each_ref().map(|of| of.bits());
    let (low, middle, high) = (_mm_fmadd_pd(z, c1, c0), _mm_fmadd_pd(z, c3, c2), _mm_fmadd_pd(z, c5, c4));
    let polynomial = _mm_fmadd_pd(z2, _mm_fmadd_pd(z2, high, middle), low);
    let tail = _mm_fmadd_pd(y, turn.half.bits(), _mm_xor_pd(t, turn.tail_negated.bits()));
    let [own, other] =
        [&turn.own, &turn.other].map(|Line(slope, at_zero)| _mm_fmadd_pd(y, slope.bits(), at_zero.bits()));
    both(_mm_fnmadd_pd(other, _mm_fmadd_pd(y3, polynomial, tail), own))
}

/// What a quadrant makes of the halves. From a table, because what is read takes none of the units that calculate.
struct Turn {
    /// Of ±S for a sine, −C for a cosine.
    coefficients: [Halves; 6],
    /// 0 for a sine, ½ for a cosine.
    half: Halves,
    /// ±y for a sine, ±1 for a cosine.
    own: Line,
    /// 1 for a sine, ±y for a cosine.
    other: Line,
    /// The sign of the tail: that of a negative sine, and of every cosine.
    tail_negated: Halves,
}

/// The slope of a function of y, and its value at zero: exact, and the same as a choice between y and a constant.
struct Line(Halves, Halves);

static TURNS: [Turn; 4] =
    [Turn::of(QUADRANTS[0]), Turn::of(QUADRANTS[1]), Turn::of(QUADRANTS[2]), Turn::of(QUADRANTS[3])];

impl Turn {
    /// A sine's y³S + t is negated, not what it is multiplied by, and has + 0 y added: so both zeros are those of the difference y − (y³S + t)
    /// that is negated at last.
    const fn of(halves: [(bool, bool); 2]) -> Self {
        const ZERO: Halves = Halves::ZERO;
        let (own, other) = (Line(ZERO, ZERO), Line(ZERO, ZERO));
        let mut turn = Self { coefficients: [ZERO; 6], half: ZERO, own, other, tail_negated: ZERO };
        let mut half = 0;
        while half < 2 {
            let (is_sine, negated) = halves[half];
            let one = if negated { -1.0_f64 } else { 1.0 };
            let mut term = 0;
            while term < 6 {
                turn.coefficients[term].0[half] = if is_sine { one * SINE[term] } else { COSINE[term] }.to_bits();
                term += 1;
            }
            turn.half.0[half] = if is_sine { 0.0_f64 } else { 0.5 }.to_bits();
            // Through −0, so that both zeros are kept.
            let through_zero = (one.to_bits(), SIGN);
            let (own, other) =
                if is_sine { (through_zero, (0, 1.0_f64.to_bits())) } else { ((0, one.to_bits()), through_zero) };
            (turn.own.0.0[half], turn.own.1.0[half]) = own;
            (turn.other.0.0[half], turn.other.1.0[half]) = other;
            turn.tail_negated.0[half] = if negated || !is_sine { SIGN } else { 0 };
            half += 1;
        }
        turn
    }
}
