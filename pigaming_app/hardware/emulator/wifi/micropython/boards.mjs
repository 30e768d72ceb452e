// Emulated boards: one worker thread with MicroPython for each robot, UDP sockets on loopback, a watchdog, and a clock.
//
// Standard input: one JSON object a line. The first configures: {"robots": [{"board": name, "divider": of the battery's
// voltage, "files": {name: base64}}, ...], "interpreter": path, "paced": bool}. Then {"now": ms, "received": [number, ...]}
// advances the clock of paced boards once each has received so many datagrams, and {"robot": index, "do": "reboot" | "off" |
// "hang loop" | "hang board" | "error" | "interrupt", "battery": mV, "reference": mV, "button": 0 | 1, "offline": 0 | 1,
// "pulses": [left, right], "cut": number} disturbs one.
// Standard output: {"ports"}, {"robot", "at", "pins"}, {"robot", "reset"}, {"robot", "printed"}, {"now"}. Times are ms: of
// the clock if paced, else of the system's monotonic clock.
import dgram from "node:dgram";
import { createInterface } from "node:readline";
import { MessageChannel, Worker } from "node:worker_threads";

export const WAKE = 0, NOW = 1, FED = 2, TIMEOUT = 3, HANG = 4, CAUSE = 5, BATTERY = 6, BUTTON = 7, FAULT = 8, OFFLINE = 9,
  PULSES = 10, REFERENCE = 12, CUT = 13, SIZE = 14;
const lines = createInterface({ input: process.stdin })[Symbol.asyncIterator]();
const first = JSON.parse((await lines.next()).value);
const monotonic = () => Number(process.hrtime.bigint() / 1000n) / 1000;
const say = (message) => process.stdout.write(JSON.stringify(message) + "\n");
const wake = (robot) => { Atomics.add(robot.numbers, WAKE, 1); Atomics.notify(robot.numbers, WAKE); };
let sending = 0;

class Robot {
  constructor(index, robot) {
    Object.assign(this, { index, robot, received: 0, idle: -1, worker: null });
    this.numbers = new Int32Array(new SharedArrayBuffer(4 * SIZE));
    this.numbers[BATTERY] = 5200;
    this.numbers[REFERENCE] = 1100;
    this.socket = dgram.createSocket({ type: "udp4", lookup: (host, options, done) => done(null, host, 4) });
    this.socket.on("message", (data, from) => {
      this.received++;
      this.inbox?.postMessage([data.toString("hex"), from.address, from.port]);
      wake(this);
      settle();
    });
  }

  async open() {
    await new Promise((done) => this.socket.bind(0, "127.0.0.1", done));
    return this.socket.address().port;
  }

  boot(cause) {
    const { port1, port2 } = new MessageChannel();
    this.inbox = port1;
    this.inbox.unref();
    this.numbers[HANG] = this.numbers[TIMEOUT] = this.numbers[FAULT] = 0;
    this.numbers[PULSES] = this.numbers[PULSES + 1] = 0;
    this.numbers[CAUSE] = cause;
    this.idle = -1;
    const worker = this.worker = new Worker(new URL("board.mjs", import.meta.url), {
      workerData: { numbers: this.numbers, inbox: port2, robot: this.robot, interpreter: first.interpreter, paced: first.paced },
      transferList: [port2],
    });
    worker.on("message", (message) => worker === this.worker && this.hear(message));
    worker.on("error", (error) => { say({ robot: this.index, failed: String(error) }); process.exitCode = 1; });
  }

  hear([kind, ...values]) {
    if (kind === "pins") say({ robot: this.index, at: values[0], pins: values[1] });
    if (kind === "idle") { this.idle = values[0]; settle(); }
    if (kind === "reset") this.reset(2);
    if (kind === "files") this.robot.files = values[0];
    if (kind === "cut") this.off().then(settle);
    if (kind === "print") say({ robot: this.index, printed: values[0] });
    if (kind === "send") {
      sending++;
      this.socket.send(Buffer.from(values[0], "hex"), values[2], values[1], () => { sending--; settle(); });
    }
  }

  async off() {
    const worker = this.worker;
    this.worker = null;
    say({ robot: this.index, at: time(), pins: {} }); // without a program all pins are inputs
    await worker?.terminate();
  }

  async reset(cause) {
    say({ robot: this.index, reset: cause });
    await this.off();
    this.boot(cause);
  }

  starved() {
    return this.worker && this.numbers[TIMEOUT] && ((time() | 0) - this.numbers[FED] | 0) > this.numbers[TIMEOUT];
  }

  ready(now) {
    return !this.worker || this.numbers[HANG] === 2 || this.idle >= now;
  }
}

const robots = first.robots.map((robot, index) => new Robot(index, robot));
let goal = null;
const time = () => first.paced ? robots[0].numbers[NOW] : monotonic();

function settle() { // report that the boards have reached the time, with all that they sent on its way
  if (!goal || sending || robots.some((robot) => !robot.ready(goal.now))) return;
  const now = goal.now;
  goal = null;
  say({ now });
}

async function advance(order) {
  for (const [index, robot] of robots.entries()) {
    for (let turns = 0; robot.received < (order.received?.[index] ?? 0) && turns < 500; turns++) {
      await new Promise((done) => setTimeout(done, 1));
    }
  }
  goal = order;
  for (const robot of robots) {
    robot.numbers[NOW] = order.now;
    if (robot.starved()) await robot.reset(3);
    wake(robot);
  }
  settle();
}

function disturb(robot, order) {
  if (order.battery !== undefined) robot.numbers[BATTERY] = order.battery;
  if (order.reference !== undefined) robot.numbers[REFERENCE] = order.reference;
  if (order.button !== undefined) robot.numbers[BUTTON] = order.button;
  if (order.offline !== undefined) robot.numbers[OFFLINE] = order.offline;
  order.pulses?.forEach((total, encoder) => { robot.numbers[PULSES + encoder] = total; });
  if (order.cut !== undefined) robot.numbers[CUT] = order.cut;
  if (order.do === "error" || order.do === "interrupt") robot.numbers[FAULT] = order.do === "error" ? 1 : 2;
  if (order.do === "reboot") robot.reset(1);
  if (order.do === "off") robot.off();
  if (order.do === "hang loop" || order.do === "hang board") robot.numbers[HANG] = order.do === "hang loop" ? 1 : 2;
  wake(robot);
}

const ports = await Promise.all(robots.map((robot) => robot.open()));
say({ ports });
if (!first.paced) setInterval(() => robots.forEach((robot) => { if (robot.starved()) robot.reset(3); }), 5);
for (const robot of robots) robot.boot(1);
for await (const line of lines) {
  const order = JSON.parse(line);
  if (order.now !== undefined) await advance(order);
  else disturb(robots[order.robot], order);
}
process.exit();
