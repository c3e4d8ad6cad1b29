//! What the compiler says to wrong declarations, and that right ones with unusual names compile.
//!
//! Every wrong case also uses its module as a user would: the pinned output shows that one mistake is one error, without others in
//! its train. `TRYBUILD=overwrite` writes the outputs anew; each is then to be read.

#[test]
fn messages() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("cases/*.rs");
    cases.pass("pass/*.rs");
}
