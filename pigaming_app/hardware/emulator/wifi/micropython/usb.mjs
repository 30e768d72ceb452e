// A board on USB: MicroPython's prompt on standard input and output, and a disk in memory. Arguments: path of the
// interpreter, and the board if its hardware is emulated, too: its pins are then told on standard error. What a prompt
// driven by events does not have is refused: raw paste. A soft reboot begins anew with the same disk.
import { readFileSync, readdirSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [interpreter, board] = process.argv.slice(2);
const { loadMicroPython } = await import(pathToFileURL(interpreter).href);
const PASTE = [5, 0x41, 1]; // CTRL-E A CTRL-A
const HARDWARE = "/hardware", BATTERY = 5000, REFERENCE = 1100; // folder of the stand-ins; mV
const clock = new Int32Array(new SharedArrayBuffer(4));
const monotonic = () => Number(process.hrtime.bigint() / 1000000n);
const nothing = () => {}, pins = {};
let changed = false, micropython, asked = 0; // bytes of PASTE that have come

function tell() {
  if (changed) process.stderr.write(JSON.stringify(pins) + "\n");
  changed = false;
}

globalThis.bridge = {
  ticks: monotonic, board: () => board, pulses: () => 0, button: () => 0, hangs: () => false, fault: () => 0,
  battery: () => BATTERY, divider: () => board === "board_pololu_2040" ? 11 : 3, reference: () => REFERENCE,
  cause: () => 1, receive: () => "", send: nothing, written: nothing, watch: nothing, feed: nothing, reset: nothing,
  pin(name, value) {
    changed ||= pins[name] !== value;
    pins[name] = value;
  },
  wait(until) {
    tell();
    Atomics.wait(clock, 0, 0, Math.max(1, until - monotonic()));
  },
};

async function boot(files) {
  micropython = await loadMicroPython({
    linebuffer: false,
    stdout: (data) => process.stdout.write(typeof data === "number" ? Uint8Array.of(data) : data),
  });
  if (board) {
    const here = new URL(".", import.meta.url);
    micropython.FS.mkdir(HARDWARE);
    for (const name of readdirSync(here).filter((name) => name.endsWith(".py"))) {
      micropython.FS.writeFile(`${HARDWARE}/${name}`, readFileSync(new URL(name, here)));
    }
    micropython.runPython(`import sys\nsys.path.append('${HARDWARE}')\nimport standins`);
    if (!board.startsWith("board_")) micropython.runPython("import microbit_prompt");
  }
  for (const [name, data] of files) micropython.FS.writeFile(name, data);
}

function disk() {
  const names = micropython.FS.readdir("/").filter((name) => micropython.FS.isFile(micropython.FS.stat(`/${name}`).mode));
  return names.map((name) => [`/${name}`, micropython.FS.readFile(`/${name}`)]);
}

async function take(byte) {
  asked = byte === PASTE[asked] ? asked + 1 : 0;
  if (asked === PASTE.length) {
    asked = 0;
    process.stdout.write(Uint8Array.of(0x52, 0)); // R, 0: understood, but not available
  } else if (!asked && micropython.replProcessChar(byte)) {
    await boot(disk());
    process.stdout.write("MPY: soft reboot\r\n");
    micropython.replInit();
    micropython.replProcessChar(1); // the prompt stays raw
  }
  tell();
}

await boot([]);
micropython.replInit();
for await (const bytes of process.stdin) for (const byte of bytes) await take(byte);
