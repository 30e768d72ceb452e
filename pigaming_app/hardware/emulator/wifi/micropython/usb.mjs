// A board on USB: MicroPython's prompt on standard input and output, and a disk in memory. The second argument: path of the
// interpreter. What its prompt driven by events does not have is refused: raw paste.
import { pathToFileURL } from "node:url";

const { loadMicroPython } = await import(pathToFileURL(process.argv[2]).href);
const PASTE = [5, 0x41, 1]; // CTRL-E A CTRL-A
const interpreter = await loadMicroPython({
  linebuffer: false,
  stdout: (data) => process.stdout.write(typeof data === "number" ? Uint8Array.of(data) : data),
});
let asked = 0; // bytes of PASTE that have come
interpreter.replInit();
process.stdin.on("data", (bytes) => {
  for (const byte of bytes) {
    asked = byte === PASTE[asked] ? asked + 1 : 0;
    if (asked === PASTE.length) {
      asked = 0;
      process.stdout.write(Uint8Array.of(0x52, 0)); // R, 0: understood, but not available
    } else if (!asked) interpreter.replProcessChar(byte);
  }
});
