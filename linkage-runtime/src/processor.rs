//! By which of the processor's vector instructions sweeps are computed: the widest that it has, unless a measurement asks for narrower
//! ones.

use core::sync::atomic::{AtomicU8, Ordering};

use pulp::Arch;

/// The widest registers that sweeps may use, bytes.
static WIDEST: AtomicU8 = AtomicU8::new(u8::MAX);

/// Keeps the sweeps of this process to registers of so many bytes: below 64 without AVX-512, below 32 without AVX2.
///
/// For measurements: results are the same, only their time differs.
pub fn limit_registers(bytes: u8) {
    WIDEST.store(bytes, Ordering::Relaxed);
}

/// The instructions for a sweep.
#[inline]
pub(crate) fn instructions() -> Arch {
    let widest = WIDEST.load(Ordering::Relaxed);
    if widest == u8::MAX { Arch::new() } else { narrower(widest) }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn narrower(widest: u8) -> Arch {
    match Arch::new() {
        wide @ Arch::V4(_) if widest >= 64 => wide,
        Arch::V4(_) | Arch::V3(_) if widest >= 32 => pulp::x86::V3::try_new().map_or(Arch::Scalar, Arch::V3),
        _ => Arch::Scalar,
    }
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn narrower(_: u8) -> Arch {
    Arch::new()
}
