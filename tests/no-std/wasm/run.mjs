// Runs the module that is named on the command line: fails if it imports anything, prints the name and the hash of every linkage.
import { readFile } from "node:fs/promises";

const module = await WebAssembly.compile(await readFile(process.argv[2]));
const imports = WebAssembly.Module.imports(module);
if (imports.length > 0) {
    console.error("the module imports", imports);
    process.exit(1);
}
const { exports } = await WebAssembly.instantiate(module);
for (const { name, kind } of WebAssembly.Module.exports(module)) {
    if (kind === "function") {
        console.log(name, BigInt.asUintN(64, exports[name]()).toString(16).padStart(16, "0"));
    }
}
