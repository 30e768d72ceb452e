// One emulated board: MicroPython in this thread, with the robot's files and stand-ins for the hardware.
import { randomBytes } from "node:crypto";
import { parentPort, receiveMessageOnPort, workerData } from "node:worker_threads";

const WAKE = 0, NOW = 1, FED = 2, TIMEOUT = 3, HANG = 4, CAUSE = 5, BATTERY = 6, BUTTON = 7, FAULT = 8, OFFLINE = 9,
  PULSES = 10, REFERENCE = 12, CUT = 13; // as in boards.mjs
const { numbers, inbox, robot, interpreter, paced } = workerData;
const monotonic = () => Number(process.hrtime.bigint() / 1000n) / 1000;
const pins = {};
let changed = false;
const time = () => paced ? Atomics.load(numbers, NOW) : monotonic();

globalThis.bridge = {
  ticks: () => Math.floor(time()),
  random: (size) => randomBytes(size).toString("hex"),
  cause: () => numbers[CAUSE],
  board: () => robot.board,
  battery: () => numbers[BATTERY],
  divider: () => robot.divider,
  reference: () => numbers[REFERENCE],
  button: () => numbers[BUTTON],
  hangs: () => numbers[HANG] === 1,
  fault: () => Atomics.exchange(numbers, FAULT, 0),
  offline: () => numbers[OFFLINE] === 1,
  pulses: (encoder) => numbers[PULSES + encoder],
  watch(ms) {
    numbers[FED] = time() | 0;
    numbers[TIMEOUT] = ms;
  },
  feed() { numbers[FED] = time() | 0; },
  reset() {
    parentPort.postMessage(["reset"]);
    Atomics.wait(numbers, HANG, numbers[HANG]); // until this thread is ended
  },
  written() { // the disk has changed: it survives a restart, and the power is cut where that was ordered
    const files = {};
    for (const folder of ["/robot", "/robot/a", "/robot/b"]) {
      if (!micropython.FS.analyzePath(folder).exists) continue;
      for (const name of micropython.FS.readdir(folder)) {
        const path = `${folder}/${name}`;
        if (micropython.FS.isFile(micropython.FS.stat(path).mode)) {
          files[path.slice(7)] = Buffer.from(micropython.FS.readFile(path)).toString("base64");
        }
      }
    }
    parentPort.postMessage(["files", files]);
    if (Atomics.load(numbers, CUT) && Atomics.sub(numbers, CUT, 1) === 1) {
      parentPort.postMessage(["cut"]);
      Atomics.wait(numbers, HANG, numbers[HANG]); // until this thread is ended
    }
  },
  pin(name, value) {
    changed ||= pins[name] !== value;
    pins[name] = value;
  },
  send(hex, host, port) { parentPort.postMessage(["send", hex, host, port]); },
  receive() {
    const found = receiveMessageOnPort(inbox);
    return found ? found.message.join(" ") : "";
  },
  wait(until) { // until a time, or until something happened
    if (changed) parentPort.postMessage(["pins", time(), { ...pins }]);
    changed = false;
    const seen = Atomics.load(numbers, WAKE);
    while (numbers[HANG] === 2) Atomics.wait(numbers, WAKE, Atomics.load(numbers, WAKE));
    if (paced) {
      const now = time();
      if (now >= until) return;
      parentPort.postMessage(["idle", now]);
      if (time() === now) Atomics.wait(numbers, WAKE, seen);
    } else Atomics.wait(numbers, WAKE, seen, Math.max(0, until - monotonic()));
  },
};

const { loadMicroPython } = await import(interpreter);
const micropython = await loadMicroPython({
  heapsize: 128 * 1024, // bytes, about that of an ESP32
  linebuffer: true,
  stdout: (line) => parentPort.postMessage(["print", line]),
  stderr: (line) => parentPort.postMessage(["print", line]),
});
micropython.FS.mkdir("/robot");
for (const [name, data] of Object.entries(robot.files)) {
  if (name.includes("/") && !micropython.FS.analyzePath(`/robot/${name.split("/")[0]}`).exists) micropython.FS.mkdir(`/robot/${name.split("/")[0]}`);
  micropython.FS.writeFile(`/robot/${name}`, Buffer.from(data, "base64"));
}
micropython.runPython("import os, sys\nos.chdir('/robot')\nsys.path.insert(0, '/robot')\nimport standins");
try {
  micropython.runPython("exec(compile(open('/robot/main.py').read(), 'main.py', 'exec'))");
} catch (error) {
  parentPort.postMessage(["print", String(error)]);
}
micropython.runPython("standins.prompt()");
