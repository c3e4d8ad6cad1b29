//! In fused operations.

/// See `halves`.
macro_rules! fused_halves {
    ($scalar:ident, $bits:ident, $terms:literal) => {
        ways_in!("sse2,fma");

        /// As in `reduce`.
        #[inline]
        #[target_feature(enable = "sse2,fma")]
        fn rounded(x: Register, turns: $scalar) -> Register {
            fmadd(x, spread(turns), spread(ROUND))
        }

        /// As in the function of this name for one number.
        #[inline]
        #[target_feature(enable = "sse2,fma")]
        fn reduced(x: Register, rounded: Register) -> Spread {
            let [high, middle, low] = FRAC_PI_2.map(|part| spread(part));
            let n = sub(rounded, spread(ROUND));
            let x1 = fnmadd(n, high, x);
            let w = mul(n, middle);
            let y = sub(x1, w);
            let t = fmadd(n, low, sub(w, sub(x1, y)));
            Spread { quadrant: first(rounded).to_bits(), y, t }
        }

        /// Both halves are own − other · (y³ · polynomial + tail): y − (y³S + t), or 1 − y ((y/2 − t) − y³C).
        #[inline]
        #[target_feature(enable = "sse2,fma")]
        fn sin_cos(Spread { quadrant, y, t }: Spread) -> ($scalar, $scalar) {
            let turn = row(&TURNS, quadrant);
            let z = mul(y, y);
            let y3 = mul(y, z);
            let polynomial = fused_polynomial(z, turn.coefficients.each_ref().map(|of| of.bits()));
            let tail = fmadd(y, turn.half.bits(), xor(t, turn.tail_negated.bits()));
            let [own, other] =
                [&turn.own, &turn.other].map(|Line(slope, at_zero)| fmadd(y, slope.bits(), at_zero.bits()));
            both(fnmadd(other, fmadd(y3, polynomial, tail), own))
        }

        /// What a quadrant makes of the halves. From a table, because what is read takes none of the units that calculate; a power of two from
        /// row to row, so that a shift finds them.
        #[repr(align(256))]
        struct Turn {
            /// Of ±S for a sine, −C for a cosine.
            coefficients: [Halves; $terms],
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

        impl Line {
            const ZERO: Self = Self(Halves::ZERO, Halves::ZERO);

            const fn with(self, half: usize, (slope, at_zero): ($bits, $bits)) -> Self {
                Self(self.0.with(half, slope), self.1.with(half, at_zero))
            }
        }

        const _: () = assert!(size_of::<Turn>() == 256);

        static TURNS: [Turn; 4] =
            [Turn::of(QUADRANTS[0]), Turn::of(QUADRANTS[1]), Turn::of(QUADRANTS[2]), Turn::of(QUADRANTS[3])];

        impl Turn {
            /// A sine's y³S + t is negated, not what it is multiplied by, and has + 0 y added: so both zeros are those of the difference
            /// y − (y³S + t) that is negated at last.
            const fn of(halves: [(bool, bool); 2]) -> Self {
                const ZERO: Halves = Halves::ZERO;
                let mut turn = Self {
                    coefficients: [ZERO; $terms],
                    half: ZERO,
                    own: Line::ZERO,
                    other: Line::ZERO,
                    tail_negated: ZERO,
                };
                let mut half = 0;
                while half < 2 {
                    let (is_sine, negated) = halves[half];
                    let one: $scalar = if negated { -1.0 } else { 1.0 };
                    let mut term = 0;
                    while term < $terms {
                        let coefficient = if is_sine { one * SINE[term] } else { COSINE[term] };
                        turn.coefficients[term] = turn.coefficients[term].with(half, coefficient.to_bits());
                        term += 1;
                    }
                    let of_y: $scalar = if is_sine { 0.0 } else { 0.5 };
                    turn.half = turn.half.with(half, of_y.to_bits());
                    // Through −0, so that both zeros are kept.
                    let through_zero = (one.to_bits(), SIGN);
                    let constant: $scalar = if is_sine { 1.0 } else { one };
                    let constant = (0, constant.to_bits());
                    let (own, other) = if is_sine { (through_zero, constant) } else { (constant, through_zero) };
                    (turn.own, turn.other) = (turn.own.with(half, own), turn.other.with(half, other));
                    turn.tail_negated = turn.tail_negated.with(half, if negated || !is_sine { SIGN } else { 0 });
                    half += 1;
                }
                turn
            }
        }
    };
}
