//! On emulated boards: all results have the bits that they have on this host.

use std::process::Command;

use no_std_proofs::{Build, assert_same, printed};

fn same_bits(target: &str, cpu: &str, machine: &str) {
    for profile in ["dev", "release"] {
        let build = Build { package: "no-std-board", targets: &[target], profile, flags: "", arguments: &[] };
        build.expect();
        let mut qemu = Command::new("timeout");
        qemu.args(["300", "qemu-system-arm", "-cpu", cpu, "-machine", machine, "-nographic"]);
        qemu.args(["-semihosting-config", "enable=on,target=native", "-kernel"]);
        qemu.arg(build.folder(target).join("no-std-board"));
        assert_same(&printed(&mut qemu, "install QEMU: `qemu-system-arm`"), &format!("{machine}, {profile}"));
    }
}

/// Single precision in hardware, double precision in software.
#[test]
#[ignore = "needs QEMU"]
fn cortex_m4f() {
    same_bits("thumbv7em-none-eabihf", "cortex-m4", "mps2-an386");
}

/// Both in software, by the instructions of a Cortex-M0.
#[test]
#[ignore = "needs QEMU"]
fn cortex_m3() {
    same_bits("thumbv6m-none-eabi", "cortex-m3", "mps2-an385");
}
