#[test]
fn show() {
    let text = std::fs::read_to_string("/tmp/dbg/in.txt").unwrap();
    match linkage_codegen::analyse(text.parse().unwrap()) {
        Ok(_) => {}
        Err(r) => {
            for e in r.errors {
                println!("ERR {}", e.message());
            }
        }
    }
    let code = linkage_codegen::formatted(linkage_codegen::expand(text.parse().unwrap())).unwrap();
    println!("{code}");
}
