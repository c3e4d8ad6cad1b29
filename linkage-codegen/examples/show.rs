fn main() {
    let src = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let t = linkage_codegen::expand(src.parse().unwrap());
    #[cfg(feature = "source")]
    match linkage_codegen::formatted(t.clone()) {
        Ok(s) => println!("{s}"),
        Err(e) => println!("{e}\n{t}"),
    }
}
