//! Reproducible arguments.

/// The generator `SplitMix64`.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let a = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let b = (a ^ (a >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        b ^ (b >> 31)
    }

    /// Uniform in [−1, 1).
    pub(crate) fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2f64.powi(-52) - 1.0
    }

    /// Any finite number: sign, exponent and significand uniform.
    pub(crate) fn finite(&mut self) -> f64 {
        loop {
            let x = f64::from_bits(self.bits());
            if x.is_finite() {
                return x;
            }
        }
    }

    /// Sign and significand uniform, the exponent within the range.
    pub(crate) fn between_powers(&mut self, low: i32, high: i32) -> f64 {
        let exponent = low + (self.bits() % (high - low) as u64) as i32;
        // In two steps: 2⁻¹⁰⁷⁴ is beyond `powi`, which divides 1 by 2¹⁰⁷⁴.
        let x = (1.0 + self.signed().abs()) * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        if self.bits() & 1 == 0 { x } else { -x }
    }
}
