//! In sums and products that are rounded one by one.

/// See `halves`.
macro_rules! plain_halves {
    ($scalar:ident, $bits:ident, $terms:literal) => {
        ways_in!("sse2");

        /// As in `reduce`.
        #[inline]
        #[target_feature(enable = "sse2")]
        fn rounded(x: Register, turns: $scalar) -> Register {
            add(mul(x, spread(turns)), spread(ROUND))
        }

        /// As in the function of this name for one number.
        #[inline]
        #[target_feature(enable = "sse2")]
        fn reduced(x: Register, rounded: Register) -> Spread {
            let [high, middle, low] = FRAC_PI_2.map(|part| spread(part));
            let n = sub(rounded, spread(ROUND));
            let x1 = sub(x, mul(n, high));
            let w = mul(n, middle);
            let y = sub(x1, w);
            let t = sub(mul(n, low), sub(sub(x1, y), w));
            Spread { quadrant: first(rounded).to_bits(), y, t }
        }

        /// The sign of the second half. Where it is used it would be made in unoptimised builds, with ways to panic.
        const SECOND_NEGATED: Halves = Halves::ZERO.with(1, SIGN);

        /// Both halves are own − (z · factor · polynomial + tail): of a sine own is y, of a cosine 1 − z/2, whose rounding goes into the tail. The
        /// own term of each half is the derivative of the other, and so the factor of its tail: (sin, cos)' = (cos, −sin).
        #[inline]
        #[target_feature(enable = "sse2")]
        fn sin_cos(Spread { quadrant, y, t }: Spread) -> ($scalar, $scalar) {
            let turn = row(&TURNS, quadrant);
            let z = mul(y, y);
            let p = polynomial(z, turn.coefficients.each_ref().map(|of| of.bits()));

            let is_sine = turn.is_sine.bits();
            let factor = or(and(is_sine, y), andnot(is_sine, z));
            let start = xor(and(is_sine, y), turn.at_zero.bits());
            let half = mul(z, turn.half.bits());
            let own = sub(start, half);
            let lost = sub(half, sub(start, own));
            let derivative = xor(exchanged(own), SECOND_NEGATED.bits());
            let tail = add(lost, mul(t, derivative));
            both(sub(own, add(mul(mul(z, factor), p), tail)))
        }

        /// What a quadrant makes of the halves. From a table, because what is read takes none of the units that calculate; a power of two from
        /// row to row, so that a shift finds them.
        #[repr(align(256))]
        struct Turn {
            /// Those of S or −C, negated where the half is.
            coefficients: [Halves; $terms],
            /// All bits of a half that is ± the sine of the reduced angle, none of one that is ± its cosine.
            is_sine: Halves,
            /// ±0 for a sine, whose sign that of y is multiplied by, ±1 for a cosine.
            at_zero: Halves,
            /// 0 for a sine, ±½ for a cosine.
            half: Halves,
        }

        const _: () = assert!(size_of::<Turn>() == 256);

        static TURNS: [Turn; 4] =
            [Turn::of(QUADRANTS[0]), Turn::of(QUADRANTS[1]), Turn::of(QUADRANTS[2]), Turn::of(QUADRANTS[3])];

        impl Turn {
            const fn of(halves: [(bool, bool); 2]) -> Self {
                const ZERO: Halves = Halves::ZERO;
                let mut turn = Self { coefficients: [ZERO; $terms], is_sine: ZERO, at_zero: ZERO, half: ZERO };
                let mut half = 0;
                while half < 2 {
                    let (is_sine, negated) = halves[half];
                    let one = if negated { -1.0 } else { 1.0 };
                    let mut term = 0;
                    while term < $terms {
                        let coefficient: $scalar = one * if is_sine { SINE[term] } else { -COSINE[term] };
                        turn.coefficients[term] = turn.coefficients[term].with(half, coefficient.to_bits());
                        term += 1;
                    }
                    let (at_zero, of_square): ($scalar, $scalar) = if is_sine { (0.0, 0.0) } else { (1.0, 0.5 * one) };
                    turn.is_sine = turn.is_sine.with(half, if is_sine { $bits::MAX } else { 0 });
                    turn.at_zero = turn.at_zero.with(half, (one * at_zero).to_bits());
                    turn.half = turn.half.with(half, of_square.to_bits());
                    half += 1;
                }
                turn
            }
        }
    };
}
