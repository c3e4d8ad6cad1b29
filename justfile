# The habits of working on this; `just` lists them. Everything at once, as it must pass: `.ci/run`.

_:
    @just --list --unsorted

# Formatting, lints, documentation: warnings are errors.
check:
    .ci/run style clippy docs

# All tests of all packages, and what is said to refused declarations.
test *arguments:
    cargo test --workspace --all-features {{arguments}}

# The tests that take minutes.
long:
    cargo test --release --workspace --exclude linkage-compile-fail --all-features --tests --no-fail-fast -- --ignored

# Of these the stress suite: every kind of group in every family of hard poses, with a table of the worst found.
stress kind="":
    cargo test --release --package linkage-codegen --test all stress::long::{{kind}} -- --ignored --nocapture

# Looks at snapshots that have changed, and accepts or refuses them (`cargo install cargo-insta`).
review:
    cargo insta test --workspace --all-features --review

# Measures what is emitted against formulas by hand and general solutions.
bench *arguments:
    cargo run --release --package linkage-bench -- {{arguments}}

# The documentation, in the browser.
docs:
    cargo doc --workspace --no-deps --all-features --open

# Targets without an operating system: no panic, no allocation, the same bits; emulated boards too.
no-std:
    .ci/run no-std board

# Pins the bits of all linkages anew, where numbers are meant to change.
digests:
    cd tests/no-std && cargo run --release --package no-std-proofs > proofs/digests.new && mv proofs/digests.new proofs/digests.txt
