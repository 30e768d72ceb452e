// The pad on a phone: touches become frames of four bytes, see ui/input/phone_messages.py.
"use strict";
(() => {
  let texts = JSON.parse(document.getElementById("texts").textContent);
  const element = (id) => document.getElementById(id);
  const BITS = { fire: 1, turbo: 2, x: 4, y: 8, start: 16 };
  const FINAL = { 4000: "page_refused", 4001: "page_refused", 4003: "page_elsewhere", 4005: "page_removed" }; // no second attempt
  const SHAPES = ["M-.95 0A.95 .95 0 1 1 .95 0A.95 .95 0 1 1-.95 0Z", "M0-1 1 .75H-1Z", "M-.85-.85H.85V.85H-.85Z", "M0-1.1 1.1 0 0 1.1-1.1 0Z"];
  const FRAME_MS = 1000 / 60, ALIVE_MS = 200, FLASH_MS = 160, OPEN_MS = 1500, RETRY_MS = [200, 400, 800, 1500];

  let socket = null, resume = sessionStorage.getItem("resume") || "", attempts = 0, retry = 0;
  let state = { seat: -1, color: "", playing: false, score: "", clock: "", place: "", before: -1, line: "", name: "", called: false };
  let x = 0, y = 0, buttons = 0, sentAt = 0, waiting = 0;
  const hall = window.hall((frame) => { if (socket && socket.readyState === 1) socket.send(Uint8Array.from(frame)); }, press);

  // ---- the connection

  function connect() {
    clearTimeout(retry);
    if (socket && socket.readyState < 2) return;
    const base = location.pathname.split("/")[1];
    const mine = socket = new WebSocket(`ws://${location.host}/${base}/pad?resume=${encodeURIComponent(resume)}`);
    mine.binaryType = "arraybuffer";
    const late = setTimeout(() => mine.close(), OPEN_MS); // a radio that is still waking up
    mine.onopen = () => { clearTimeout(late); send(); };
    mine.onmessage = (event) => receive(JSON.parse(event.data));
    mine.onclose = (event) => { clearTimeout(late); if (socket === mine) closed(event.code); };
  }

  function closed(code) {
    socket = null;
    document.body.classList.add("closed");
    document.body.classList.toggle("refused", code === 4002 || code in FINAL);
    release();
    show(texts[FINAL[code]] || (code === 4002 ? texts.page_full : texts.page_lost));
    if (FINAL[code] || document.hidden) return;
    const wait = code === 4002 ? 3000 : RETRY_MS[Math.min(attempts++, RETRY_MS.length - 1)];
    retry = setTimeout(attempts % 4 ? connect : check, wait);
  }

  // A refused socket gives no reason: ask for the page itself.
  function check() {
    fetch(location.pathname, { cache: "no-store" }).then(
      (answer) => (answer.status === 403 ? old() : connect()), connect);
  }

  function old() {
    document.body.classList.add("refused");
    show(texts.page_old);
  }

  function receive(message) {
    if (message.resume) {
      resume = message.resume;
      sessionStorage.setItem("resume", resume);
      attempts = 0;
      document.body.classList.remove("closed", "refused");
    }
    if (message.texts) texts = message.texts;
    if (message.state) state = message.state;
    if (message.texts || message.state) dress();
    if (message.ballot) hall.ballot(message.ballot);
    if ("name" in message) hall.named(message);
    if (message.rumble) shake(...message.rumble);
  }

  function show(text) { element("message").textContent = text; }

  // ---- what the arcade reports

  function dress() {
    const seated = state.seat >= 0, turn = !seated && state.before === -1;
    document.documentElement.style.setProperty("--seat", state.color || "#96acce");
    const who = state.place || state.name || texts.page_player.replace("{player}", state.seat + 1);
    element("seat").textContent = seated ? who : turn ? (state.called ? texts.page_called : texts.page_join) : state.name;
    element("score").textContent = state.score;
    element("clock").textContent = state.clock;
    element("shape").style.display = seated ? "" : "none";
    if (seated) element("shape").firstElementChild.setAttribute("d", SHAPES[state.seat]);
    document.body.classList.toggle("playing", state.playing);
    const words = state.playing ? ["page_fire", "page_turbo"] : ["page_ok", "page_back"];
    ["fire", "turbo"].forEach((id, i) => { element(id).lastElementChild.textContent = texts[words[i]]; });
    hall.dress(state, texts);
    if (!seated && !turn && (buttons || x || y)) release();
  }

  function shake(strong, weak, milliseconds) {
    const shaken = navigator.vibrate && navigator.vibrate(strong + weak > 0 ? milliseconds : 0);
    if (shaken || milliseconds === 0 || strong + weak < 0.5) return;
    element("flash").classList.add("lit");
    setTimeout(() => element("flash").classList.remove("lit"), FLASH_MS);
  }

  // ---- what the player touches

  function send() {
    if (!socket || socket.readyState !== 1) return;
    const frame = Int8Array.of(1, Math.round(127 * x), Math.round(127 * y), buttons);
    sentAt = performance.now();
    socket.send(frame);
  }

  // Buttons go at once, the stick at most 60 times a second.
  function moved() {
    const left = FRAME_MS - (performance.now() - sentAt);
    if (left <= 0) send();
    else if (!waiting) waiting = setTimeout(() => { waiting = 0; send(); }, left);
  }

  setInterval(() => { if (performance.now() - sentAt >= ALIVE_MS - 20) send(); }, ALIVE_MS);

  function press(id, down) {
    const before = buttons;
    buttons = down ? buttons | BITS[id] : buttons & ~BITS[id];
    element(id).classList.toggle("down", down);
    if (buttons !== before) send();
  }

  const fingers = {}; // what each pointer touches: the name of a button, or "stick"
  let centre = null;

  // The nearest of FIRE and TURBO on the right half, so that a thumb need not aim.
  function nearest(event) {
    const distance = (id) => {
      const box = element(id).getBoundingClientRect();
      return Math.hypot(event.clientX - box.x - box.width / 2, event.clientY - box.y - box.height / 2) - box.width / 2;
    };
    return distance("fire") <= distance("turbo") ? "fire" : "turbo";
  }

  const own = (event) => event.target.closest("#hall, #sheet, #me, #full"); // what the browser handles

  function touch(event) {
    if (own(event)) return;
    event.preventDefault();
    const target = event.target.closest("button, #stick, #buttons");
    if (!target || event.pointerId in fingers) return;
    if (target.id === "stick") {
      if (Object.values(fingers).includes("stick")) return;
      fingers[event.pointerId] = "stick";
      centre = [event.clientX, event.clientY];
      place(event);
    } else if (target.id in BITS || target.id === "buttons") {
      const id = target.id in BITS ? target.id : nearest(event);
      fingers[event.pointerId] = id;
      press(id, true);
    }
  }

  function move(event) {
    const id = fingers[event.pointerId];
    if (id === "stick") place(event);
    else if (id === "fire" || id === "turbo") slide(event, id);
  }

  // A thumb that slides from one of FIRE and TURBO to the other.
  function slide(event, id) {
    const over = document.elementFromPoint(event.clientX, event.clientY);
    if (over && over.id !== id && (over.id === "fire" || over.id === "turbo")) {
      fingers[event.pointerId] = over.id;
      if (!Object.values(fingers).includes(id)) press(id, false);
      press(over.id, true);
    }
  }

  function lift(event) {
    const id = fingers[event.pointerId];
    delete fingers[event.pointerId];
    if (id === "stick") centred();
    else if (id && !Object.values(fingers).includes(id)) press(id, false);
  }

  function place(event) {
    const reach = element("base").offsetWidth / 2;
    let dx = event.clientX - centre[0], dy = event.clientY - centre[1];
    const far = Math.hypot(dx, dy);
    if (far > reach) { // the stick follows a thumb that wanders
      centre = [centre[0] + dx * (1 - reach / far), centre[1] + dy * (1 - reach / far)];
      dx *= reach / far;
      dy *= reach / far;
    }
    const box = element("stick").getBoundingClientRect();
    at("base", centre[0] - box.x, centre[1] - box.y);
    at("knob", centre[0] + dx - box.x, centre[1] + dy - box.y);
    [x, y] = [dx / reach, dy / reach];
    moved();
  }

  function at(id, left, top) { Object.assign(element(id).style, { left: `${left}px`, top: `${top}px` }); }

  function centred() {
    for (const id of ["base", "knob"]) Object.assign(element(id).style, { left: "", top: "" });
    x = y = 0;
    send();
  }

  function release() {
    for (const id of Object.keys(fingers)) delete fingers[id];
    for (const id of Object.keys(BITS)) element(id).classList.remove("down");
    buttons = 0;
    centred();
  }

  addEventListener("pointerdown", touch);
  addEventListener("pointermove", move);
  addEventListener("pointerup", lift);
  addEventListener("pointercancel", lift);
  addEventListener("contextmenu", (event) => event.preventDefault());
  addEventListener("touchmove", (event) => { if (!own(event)) event.preventDefault(); }, { passive: false });
  if (!document.documentElement.requestFullscreen) element("full").style.display = "none"; // iPhones
  element("full").addEventListener("click", () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else document.documentElement.requestFullscreen().then(
      () => screen.orientation?.lock?.("landscape")?.catch(() => {}), () => {}); // which some allow in full screen only
  });

  // A locked phone, or another page in front, is an unplugged pad.
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) { clearTimeout(retry); if (socket) { socket.close(); closed(1000); } }
    else back();
  });
  addEventListener("pageshow", back);
  addEventListener("online", back);

  // Unlocked: at once, whatever was attempted before.
  function back() { attempts = 0; connect(); }

  show(texts.page_lost);
  dress();
  connect();
})();
