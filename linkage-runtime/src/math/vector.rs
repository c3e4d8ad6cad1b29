//! Directions and vectors of given length.

/// Needs `sqrt` and `sin_cos`.
macro_rules! vectors {
    ($scalar:ident, $bits:ident) => {
        /// The direction of (x, y): (x, y)/√(x² + y²), and (x, y) itself for a vector of zeros.
        ///
        /// The vector is first scaled by the power of two that brings its larger component to about 1, so that nothing
        /// overflows or underflows: the result is the same for (2ᵏx, 2ᵏy).
        ///
        /// Error: at most 1.5 ε of the norm, and of each component in proportion to its size. NaN in both if an argument is not
        /// finite.
        #[inline]
        #[must_use]
        pub fn unit(x: $scalar, y: $scalar) -> ($scalar, $scalar) {
            let scale = scale(if x.abs() > y.abs() { x.abs() } else { y.abs() });
            let (x, y) = (x * scale, y * scale);
            let norm = sqrt(x * x + y * y);
            let norm = if norm == 0.0 { 1.0 } else { norm };
            (x / norm, y / norm)
        }

        /// The vector of length r at an angle from the x axis: (r cos, r sin).
        ///
        /// Error: at most 1.3 ε of each component. NaN in both if an argument is not finite.
        #[inline]
        #[must_use]
        pub fn polar(r: $scalar, angle: $scalar) -> ($scalar, $scalar) {
            let (sin, cos) = sin_cos(angle);
            // Infinity becomes NaN, anything finite stays.
            let r = r + 0.0 * r;
            (r * cos, r * sin)
        }

        /// A power of two, whose product with the magnitude is from 1/2 to 4, and below that for subnormal numbers only; NaN if
        /// the magnitude is infinite.
        #[inline]
        fn scale(magnitude: $scalar) -> $scalar {
            // The exponents, as bits, of infinity and of one, and the last bit of an exponent.
            const EXPONENT: $bits = $scalar::INFINITY.to_bits();
            const ONE: $bits = <$scalar>::to_bits(1.0);
            const LAST: $bits = $scalar::MIN_POSITIVE.to_bits();
            // As constants, since unoptimised builds ask of what is computed whether it is too large.
            const OPPOSITE: $bits = 2 * ONE - LAST;
            const LARGEST: $bits = 2 * (ONE - LAST);
            let exponent = magnitude.to_bits() & EXPONENT;
            let inverse = OPPOSITE.wrapping_sub(exponent.min(LARGEST));
            $scalar::from_bits(if exponent == EXPONENT { EXPONENT | 1 } else { inverse })
        }
    };
}
pub(super) use vectors;
