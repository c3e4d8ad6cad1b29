//! Sine and cosine in the two halves of what a register of x86-64 holds: the bits of `Reduced::one_by_one`, or of the fused ones, in half as
//! many instructions.
//!
//! What the quadrant exchanges and negates is exchanged and negated before the polynomials, not after them, where nothing waits for it: each
//! half begins as the sine or the cosine that it will be.
//!
//! Each scalar has a module `pair` with a type `Register` and these operations of both halves: `add`, `sub`, `mul`, `xor`, `and`, `andnot` (of
//! which the first number is complemented), `or`; `spread` for a number in both halves; `load`; `first`, the number in the first half;
//! `exchanged`; and `polynomial`, the sums with coefficients that are halves. Fused operations are `fmadd` and `fnmadd`, the third number plus, or
//! less, the product of the others; then the sums are those of `fused_polynomial`. A register of singles has four places, of which
//! the last two repeat the first two.

/// `plain` and `fused`, of a scalar with polynomials of so many coefficients, and what belongs to both.
macro_rules! halves {
    ($scalar:ident, $bits:ident, $terms:literal) => {
        use super::sin_cos::Reduced;

        /// A reduced angle, its y and t in both halves.
        struct Spread {
            quadrant: $bits,
            y: Register,
            t: Register,
        }

        impl Spread {
            #[inline]
            #[target_feature(enable = "sse2")]
            fn of(Reduced { quadrant, y, t }: Reduced) -> Self {
                Self { quadrant, y: twice(y), t: twice(t) }
            }
        }

        const SIGN: $bits = 1 << ($bits::BITS - 1);

        /// How many numbers a register holds.
        const PLACES: usize = size_of::<Register>() / size_of::<$bits>();

        /// The bits of both halves, where an instruction can take them from memory.
        #[derive(Clone, Copy)]
        #[repr(C, align(16))]
        struct Halves([$bits; PLACES]);

        impl Halves {
            const ZERO: Self = Self([0; PLACES]);

            /// The same, with these bits in one of the halves.
            const fn with(mut self, half: usize, bits: $bits) -> Self {
                let mut place = half;
                while place < PLACES {
                    self.0[place] = bits;
                    place += 2;
                }
                self
            }

            #[inline]
            #[target_feature(enable = "sse2")]
            fn bits(&self) -> Register {
                // SAFETY: sixteen bytes are read of sixteen, at a multiple of sixteen.
                unsafe { load(self.0.as_ptr().cast()) }
            }
        }

        /// The row of a quadrant in a table.
        #[inline]
        fn row<T>(table: &'static [T; 4], quadrant: $bits) -> &'static T {
            table.get((quadrant & 3) as usize).unwrap_or(&table[0])
        }

        /// The numbers of both halves.
        #[inline]
        #[target_feature(enable = "sse2")]
        fn both(halves: Register) -> ($scalar, $scalar) {
            (first(halves), first(exchanged(halves)))
        }

        /// A number in both halves, unknown to the compiler, which would calculate squares of the number alone and spread each over a register.
        #[inline]
        #[target_feature(enable = "sse2")]
        fn twice(number: $scalar) -> Register {
            let mut halves = spread(number);
            // SAFETY: no instruction at all.
            unsafe {
                core::arch::asm!("/* {0} */", inout(xmm_reg) halves, options(pure, nomem, nostack, preserves_flags));
            }
            halves
        }

        /// The ways in, with these instructions: needs `rounded`, `reduced` and `sin_cos`, each of both halves.
        macro_rules! ways_in {
            ($instructions:literal) => {
                /// For angles of the short reduction.
                #[inline(always)]
                #[allow(clippy::inline_always, reason = "as `sin_cos`")]
                pub(in super::super) fn short(x: $scalar) -> ($scalar, $scalar) {
                    #[inline]
                    #[target_feature(enable = $instructions)]
                    fn halves(x: $scalar) -> ($scalar, $scalar) {
                        let x = twice(x);
                        sin_cos(reduced(x, rounded(x, core::$scalar::consts::FRAC_2_PI)))
                    }
                    // SAFETY: this module is compiled only where all code may use these instructions.
                    unsafe { halves(x) }
                }

                /// For half of an angle.
                #[inline(always)]
                #[allow(clippy::inline_always, reason = "as `sin_cos`")]
                pub(in super::super) fn short_half(x: $scalar) -> ($scalar, $scalar) {
                    #[inline]
                    #[target_feature(enable = $instructions)]
                    fn halves(x: $scalar) -> ($scalar, $scalar) {
                        let x = twice(x);
                        sin_cos(reduced(mul(spread(0.5), x), rounded(x, core::$scalar::consts::FRAC_1_PI)))
                    }
                    // SAFETY: as in `short`.
                    unsafe { halves(x) }
                }

                /// For an angle that is reduced.
                #[inline(always)]
                #[allow(clippy::inline_always, reason = "as `sin_cos`")]
                pub(in super::super) fn of(reduced: Reduced) -> ($scalar, $scalar) {
                    // SAFETY: as in `short`.
                    unsafe { sin_cos(Spread::of(reduced)) }
                }
            };
        }

        pub(super) mod plain {
            use super::super::super::halves::QUADRANTS;
            use super::super::sin_cos::{COSINE, FRAC_PI_2, ROUND, Reduced, SINE};
            use super::{
                Halves, Register, SIGN, Spread, add, and, andnot, both, exchanged, first, mul, or, polynomial, row, spread,
                sub, twice, xor,
            };

            plain_halves!($scalar, $bits, $terms);
        }

        #[cfg(target_feature = "fma")]
        pub(super) mod fused {
            use super::super::super::halves::QUADRANTS;
            use super::super::fused::{COSINE, FRAC_PI_2, SINE};
            use super::super::sin_cos::{ROUND, Reduced};
            use super::{
                Halves, Register, SIGN, Spread, both, first, fmadd, fnmadd, fused_polynomial, mul, row, spread, sub, twice,
                xor,
            };

            fused_halves!($scalar, $bits, $terms);
        }
    };
}

/// The halves that are sin x and cos x in each quadrant: whether it is the sine of the reduced angle, not the cosine, and whether it is the
/// negative of that.
pub(super) const QUADRANTS: [[(bool, bool); 2]; 4] = [
    [(true, false), (false, false)],
    [(false, false), (true, true)],
    [(true, true), (false, true)],
    [(false, true), (true, false)],
];

#[cfg(target_feature = "fma")]
#[macro_use]
mod fused;
#[macro_use]
mod plain;

#[cfg(test)]
mod tests {
    /// For angles by this step, for smaller and smaller ones from 1 on, whose bits differ by about so much, and for multiples of π/2, which is
    /// given in two parts.
    macro_rules! have_the_bits_of_one_by_one {
        ($scalar:ident, $step:literal, $smaller:literal, $rest:literal) => {
            mod $scalar {
                use crate::math::$scalar::{
                    fused_sin_cos, fused_sin_cos_half, fused_sin_cos_sum, short_angle, short_angle_sum,
                    short_fused_angle, short_fused_angle_sum, short_fused_sin_cos, short_sin_cos, sin_cos,
                    sin_cos_half, sin_cos_sum,
                };

                fn one_by_one((quarters, rest, tail): ($scalar, $scalar, $scalar)) -> ($scalar, $scalar) {
                    short_sin_cos(quarters, rest, tail)
                }

                fn fused_one_by_one((quarters, rest, tail): ($scalar, $scalar, $scalar)) -> ($scalar, $scalar) {
                    short_fused_sin_cos(quarters, rest, tail)
                }

                #[track_caller]
                fn assert_same(halves: ($scalar, $scalar), one_by_one: ($scalar, $scalar), x: $scalar) {
                    let bits = |(sin, cos): ($scalar, $scalar)| [sin.to_bits(), cos.to_bits()];
                    assert_eq!(bits(halves), bits(one_by_one), "{x:e}");
                }

                #[test]
                fn halves_have_the_bits_of_one_by_one() {
                    let turns =
                        (0_u16..50_000).flat_map(|i| [0.0, 0.25, 0.5, 0.75].map(|part| $scalar::from(i) + part));
                    let turns = turns.map(|i| i * $step);
                    let small = (0..2000).map(|i| $scalar::from_bits(<$scalar>::to_bits(1.0) - $smaller * i));
                    for x in turns.chain(small).chain([0.0, <$scalar>::from_bits(1)]) {
                        for x in [x, -x] {
                            assert_same(sin_cos(x), one_by_one(short_angle(x)), x);
                            assert_same(sin_cos_half(x), one_by_one(short_angle(0.5 * x)), x);
                            assert_same(fused_sin_cos(x), fused_one_by_one(short_fused_angle(x)), x);
                            assert_same(fused_sin_cos_half(x), fused_one_by_one(short_fused_angle(0.5 * x)), x);
                        }
                    }
                }

                /// Where nothing is left of a reduced angle, the sign of zero is the same too.
                #[test]
                fn halves_have_the_bits_of_one_by_one_at_quarter_turns() {
                    for quarters in [-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0] {
                        let (hi, lo) = (0.25 * quarters * core::$scalar::consts::PI, 0.25 * quarters * $rest);
                        for (hi, lo) in [(hi, lo), (2.0 * hi, 2.0 * lo)] {
                            for x in [0.0, -0.0] {
                                assert_same(sin_cos_sum(x, hi, lo), one_by_one(short_angle_sum(x, hi, lo)), hi);
                                let fused = fused_one_by_one(short_fused_angle_sum(x, hi, lo));
                                assert_same(fused_sin_cos_sum(x, hi, lo), fused, hi);
                            }
                        }
                    }
                }
            }
        };
    }

    have_the_bits_of_one_by_one!(f64, 0.054_8, 0x0001_3579_BDF0_2468, 1.224_646_799_147_353_2e-16);
    have_the_bits_of_one_by_one!(f32, 0.008, 0x0004_1357, -8.742_278e-8);
}
