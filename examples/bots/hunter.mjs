// A program that plays PiTanks, as hunter.py does:
//
//     python3 main.py bots --add ada  prints a key
//     node examples/bots/hunter.mjs ws://127.0.0.1:8789/ ada KEY
//
// It waits for the arcade. Needs Node.js 22, or an older one with the package ws (`npm install ws`). The messages are described in docs/bots.md.

import { createHmac } from "node:crypto";

const WebSocket = globalThis.WebSocket ?? (await import("ws")).WebSocket;
const [url, name, key] = process.argv.slice(2);
let socket;
let nonce = "";

function send(message) {
  const text = JSON.stringify(message);
  const sign = createHmac("sha256", key).update(nonce + text).digest("hex");
  socket.send(`${sign} ${text}`);
}

// The command for a tick: stick from -1 to 1, forward and clockwise, and the button.
function decide({ robots, seat }) {
  const own = robots[seat];
  const distance = (one) => Math.hypot(one.x - own.x, one.y - own.y);
  const others = robots.filter((one) => one.present && one.team !== own.team);
  if (!others.length) return {};
  const target = others.reduce((best, one) => (distance(one) < distance(best) ? one : best));
  const turn = Math.atan2(target.y - own.y, target.x - own.x) - own.heading;
  const bearing = Math.atan2(Math.sin(turn), Math.cos(turn));
  return {
    linear: Math.abs(bearing) < 0.5 ? 1 : 0,
    angular: Math.max(-1, Math.min(1, 2 * bearing)),
    fire: Math.abs(bearing) < 0.1,
  };
}

function connect() {
  let open = false;
  socket = new WebSocket(url);
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(data);
    open = true;
    if (message.type === "hello") {
      nonce = message.nonce;
      send({ type: "play", name });
    } else if (message.type === "tick") {
      const { match, seat, tick } = message;
      send({ type: "act", match, seat, tick, ...decide(message) });
    }
  };
  socket.onerror = () => {};
  socket.onclose = ({ code }) => {
    if (open) console.log(`closed with ${code}`);
    else setTimeout(connect, 500); // nobody listens yet
  };
}

connect();
