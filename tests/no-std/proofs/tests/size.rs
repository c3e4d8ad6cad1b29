//! How much of the flash a scene takes, with everything that it calls: `cargo test --test size -- --nocapture` prints it.

use no_std_proofs::Build;
use object::{Object, ObjectSection, SectionKind};

/// Floating point in hardware, then in software.
const LIMITS: &[(&str, u64)] =
    &[("thumbv7em-none-eabihf", 1500), ("riscv32imafc-unknown-none-elf", 2000), ("thumbv6m-none-eabi", 5000)];

/// The torque of a four-bar from the angle of its crank, in single precision.
#[test]
fn a_torque_is_small() {
    for (target, limit) in LIMITS {
        let build = Build {
            package: "no-std-firmware",
            targets: &[target],
            profile: "small",
            flags: "",
            arguments: &["--bin", "torque"],
        };
        build.expect();
        let file = std::fs::read(build.folder(target).join("torque")).expect("the program");
        let file = object::File::parse(&*file).expect("an ELF file");
        let mut size = 0;
        for section in file.sections() {
            match section.kind() {
                SectionKind::Text | SectionKind::ReadOnlyData => size += section.size(),
                SectionKind::Data | SectionKind::UninitializedData => assert_eq!(section.size(), 0, "static memory"),
                _ => {}
            }
        }
        println!("{target}: {size} bytes of flash");
        assert!(size > 500, "{target}: in {size} bytes there is no torque");
        assert!(size <= *limit, "{target}: {size} bytes are more than {limit}");
    }
}
