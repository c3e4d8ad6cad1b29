//! The angle of a vector.

/// Needs `FRAC_PI_4` in two parts, `UPPER`, the bits of a number's upper half, `TINY`, below which a ratio is its own arctangent, `LARGE` and
/// `SMALL`, beyond which numbers are brought `DOWN` and `UP`, and `polynomial`, which is P.
macro_rules! atan2 {
    ($scalar:ident) => {
        /// The angle of the vector (x, y) from the x axis, from −π to π.
        ///
        /// The ratio q of the smaller to the larger magnitude, or (q − 1)/(q + 1) with π/4 added where q > √2 − 1, is divided
        /// with its remainder (Dekker 1971), so that it carries no error to speak of. Then atan q = q − q³P(q²), with eleven coefficients, in
        /// single precision five, found by Remez exchange. The octant adds 0, 1, … 4 times π/4, in two parts.
        ///
        /// Error: at most 0.70 ulp for all finite x and y, whatever their size. Zeros and signs are those of IEEE 754: ±0 for
        /// y = ±0 with x ≥ +0, ±π, rounded, for y = ±0 with x ≤ −0. NaN if an argument is not finite.
        #[inline]
        #[must_use]
        pub fn atan2(y: $scalar, x: $scalar) -> $scalar {
            let steep = y.abs() > x.abs();
            let (small, large) = if steep { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
            let scale = scale(large);
            let small = small * scale;
            let large = if large == 0.0 { 1.0 } else { large * scale };

            let near = small > 0.4142 * large;
            let (numerator, denominator) = if near { (small - large, small + large) } else { (small, large) };
            let quotient = numerator / denominator;
            let rounding = if near {
                // The sums are not exact: what they lost belongs to the remainder.
                (small - (numerator + large)) - quotient * (small - (denominator - large))
            } else {
                0.0
            };
            let remainder = remainder(numerator, quotient, denominator) + rounding;
            // A tiny ratio is its own arctangent; what underflowed in its remainder must go, but NaN must stay.
            let remainder = if quotient.abs() < TINY { 0.0 * remainder } else { remainder };

            let z = quotient * quotient;
            let p = polynomial(z);
            // The derivative of the arctangent is 1/(1 + z).
            let tail = remainder / (denominator + z * denominator) - quotient * z * p;

            // The octant: eighths·π/4 ± the arctangent.
            let left = x.is_sign_negative();
            let eighths = if near { 1.0 } else { 0.0 };
            let eighths = if steep { 2.0 - eighths } else { eighths };
            let eighths = if left { 4.0 - eighths } else { eighths };
            let (head, tail) = if steep == left { (quotient, tail) } else { (-quotient, -tail) };
            let base = eighths * FRAC_PI_4[0];
            let sum = base + head;
            let rounding = (base - sum) + head;
            (sum + (rounding + (eighths * FRAC_PI_4[1] + tail))).copysign(y)
        }

        /// A power of two that keeps the sums, quotients and remainders of `atan2` from overflow and underflow.
        #[inline]
        fn scale(large: $scalar) -> $scalar {
            if large > LARGE {
                DOWN
            } else if large < SMALL {
                UP
            } else {
                1.0
            }
        }

        /// What the rounded quotient leaves of the numerator, in halves of significands whose products are exact.
        #[inline]
        fn remainder(numerator: $scalar, quotient: $scalar, denominator: $scalar) -> $scalar {
            let q = $scalar::from_bits(quotient.to_bits() & UPPER);
            let d = $scalar::from_bits(denominator.to_bits() & UPPER);
            let (q_rest, d_rest) = (quotient - q, denominator - d);
            numerator - q * d - q * d_rest - q_rest * d - q_rest * d_rest
        }
    };
}
pub(super) use atan2;
