//! In sums and products that are rounded one by one.

use core::arch::x86_64::{
    __m128d, _mm_add_pd, _mm_and_pd, _mm_andnot_pd, _mm_cvtsd_f64, _mm_mul_pd, _mm_set1_pd, _mm_sub_pd, _mm_xor_pd,
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

/// Of the cosine's sum all terms but the first are carried as negatives, so that both are differences.
#[inline]
#[target_feature(enable = "sse2")]
fn sin_cos(Spread { quadrant, y, t }: Spread) -> (f64, f64) {
    let (turn, one) = (row(&TURNS, quadrant), _mm_set1_pd(1.0));
    let z = _mm_mul_pd(y, y);
    let z2 = _mm_mul_pd(z, z);
    let half = _mm_mul_pd(_mm_set1_pd(0.5), z);
    let w = _mm_sub_pd(one, half);
    let lost = _mm_sub_pd(half, _mm_sub_pd(one, w));
    let [k0, k1, k2, k3, k4, k5] = turn.coefficients.each_ref().map(|of| of.bits());
    let p0 = _mm_add_pd(k0, _mm_mul_pd(z, k1));
    let p1 = _mm_add_pd(k2, _mm_mul_pd(z, k3));
    let p2 = _mm_add_pd(k4, _mm_mul_pd(z, k5));
    let p = _mm_add_pd(_mm_add_pd(p0, _mm_mul_pd(z2, p1)), _mm_mul_pd(_mm_mul_pd(z2, z2), p2));
    let Parts { first, own, other, tail, lost } = turn.parts([y, z, w, t, lost]);
    let tail = _mm_add_pd(lost, _mm_mul_pd(tail, other));
    both(_mm_sub_pd(own, _mm_add_pd(_mm_mul_pd(_mm_mul_pd(z, first), p), tail)))
}

/// What a quadrant makes of the halves, in bits. From a table, because what is read takes none of the units that calculate.
struct Turn {
    /// Those of S or −C, negated where the half is.
    coefficients: [Halves; 6],
    /// All bits of a half that is ± the sine of the reduced angle, none of one that is ± its cosine.
    is_sine: Halves,
    /// The sign of a half that is the negative.
    negated: Halves,
    /// The sign of the tail: of a cosine it is the opposite.
    tail_negated: Halves,
}

static TURNS: [Turn; 4] =
    [Turn::of(QUADRANTS[0]), Turn::of(QUADRANTS[1]), Turn::of(QUADRANTS[2]), Turn::of(QUADRANTS[3])];

/// What the halves are made of, exchanged and negated.
struct Parts {
    /// y or z, which the polynomial is multiplied by beside z.
    first: __m128d,
    /// The first term of each half, y or w.
    own: __m128d,
    /// What its tail is multiplied by, w or y.
    other: __m128d,
    tail: __m128d,
    /// What the first term of a cosine has lost.
    lost: __m128d,
}

impl Turn {
    const fn of(halves: [(bool, bool); 2]) -> Self {
        const ZERO: Halves = Halves::ZERO;
        let mut turn = Self { coefficients: [ZERO; 6], is_sine: ZERO, negated: ZERO, tail_negated: ZERO };
        let mut half = 0;
        while half < 2 {
            let (is_sine, negated) = halves[half];
            let mut term = 0;
            while term < 6 {
                let coefficient = if is_sine { SINE[term] } else { -COSINE[term] };
                let coefficient = if negated { -coefficient } else { coefficient };
                turn.coefficients[term].0[half] = coefficient.to_bits();
                term += 1;
            }
            turn.is_sine.0[half] = if is_sine { u64::MAX } else { 0 };
            turn.negated.0[half] = if negated { SIGN } else { 0 };
            turn.tail_negated.0[half] = if negated == is_sine { SIGN } else { 0 };
            half += 1;
        }
        turn
    }

    /// Of y, z, w, the tail and what w has lost.
    #[inline]
    #[target_feature(enable = "sse2")]
    fn parts(&self, [y, z, w, t, lost]: [__m128d; 5]) -> Parts {
        let (is_sine, negated) = (self.is_sine.bits(), self.negated.bits());
        let differing = _mm_and_pd(_mm_xor_pd(y, w), is_sine);
        Parts {
            first: _mm_xor_pd(z, _mm_and_pd(_mm_xor_pd(y, z), is_sine)),
            own: _mm_xor_pd(_mm_xor_pd(w, differing), negated),
            other: _mm_xor_pd(y, differing),
            tail: _mm_xor_pd(t, self.tail_negated.bits()),
            // Zero for a sine, whatever its sign: −0 from the rest stays −0.
            lost: _mm_andnot_pd(is_sine, _mm_xor_pd(lost, negated)),
        }
    }
}
