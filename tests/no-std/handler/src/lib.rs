//! The handler of panics that no program may reach.
#![no_std]

unsafe extern "C" {
    // Defined nowhere: where a panic can be reached, this symbol is missing and the program does not link.
    fn a_panic_is_reachable() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    // SAFETY: the program does not link.
    unsafe { a_panic_is_reachable() }
}
