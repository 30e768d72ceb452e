// The phone as camera: opens the rear camera, and sends its newest picture whenever the last one has arrived.
// Messages: see pigaming_app/hardware/vision/phone.py.
"use strict";
(() => {
  const texts = JSON.parse(document.getElementById("texts").textContent);
  const element = (id) => document.getElementById(id), video = element("video"), token = location.pathname.split("/")[1];
  const PICTURE = 1, ECHO = 2, TRACK = 3, QUALITY = 0.8, ALIVE_MS = 500, RETRY_MS = 500, STALLED_MS = 1500, LATE_MS = 3000;
  const WANTED = { facingMode: { ideal: "environment" }, width: { ideal: 1280, min: 1280 }, height: { ideal: 720, min: 720 }, frameRate: { ideal: 30 }, resizeMode: { ideal: "none" } };
  const CLOSED = { 4000: "refused", 4001: "refused", 4003: "elsewhere" };

  let socket = null, stream = null, track = null, lock = null, opening = false, final = "", trouble = "", everOpen = false, failures = 0;
  let newest = -1, inTransit = false, ready = null, sent = 0, seenAt = 0, arrivedAt = 0, since = performance.now(), rate = 0;

  const phone = name();

  // A name for itself, by which the arcade knows the phone that it was calibrated with.
  function name() {
    let kept = null;
    try { kept = localStorage.getItem("camera"); } catch (error) { /* private mode */ }
    if (!/^[0-9a-f]{32}$/.test(kept || "")) {
      kept = Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
      try { localStorage.setItem("camera", kept); } catch (error) { /* it is another phone after a reload */ }
    }
    return kept;
  }

  // ---- the connection

  function connect() {
    if (final || document.hidden || (socket && socket.readyState < 2)) return;
    const mine = socket = new WebSocket(`wss://${location.host}/${token}/pictures?phone=${phone}`);
    mine.binaryType = "arraybuffer";
    const late = setTimeout(() => mine.close(), LATE_MS);
    mine.onopen = () => { clearTimeout(late); everOpen = true; failures = 0; inTransit = true; arrivedAt = performance.now(); report(); tell(); };
    mine.onmessage = (event) => { if (socket === mine) receive(JSON.parse(event.data)); };
    mine.onclose = (event) => {
      clearTimeout(late);
      if (socket !== mine) return;
      socket = null;
      failures += 1;
      if (CLOSED[event.code]) final = CLOSED[event.code];
      else if (failures % 4 === 0) check();
      tell();
    };
  }

  // A refused socket gives no reason: ask for the page itself.
  function check() {
    fetch(location.pathname, { cache: "no-store" }).then((answer) => { if (answer.status === 403) { final = "old"; tell(); } }, () => {});
  }

  function send(kind, numbers, content) {
    if (!socket || socket.readyState !== 1) return;
    const head = 1 + 8 * numbers.length, message = new Uint8Array(head + (content ? content.byteLength : 0)), view = new DataView(message.buffer);
    view.setUint8(0, kind);
    numbers.forEach((number, i) => view.setFloat64(1 + 8 * i, number));
    if (content) message.set(new Uint8Array(content), head);
    socket.send(message);
  }

  function receive(message) {
    if ("ack" in message) {
      send(ECHO, [message.ack, performance.now() / 1000]);
      inTransit = false;
      arrivedAt = performance.now();
      forward();
    }
    if (message.set) adjust(message.set);
  }

  // The newest encoded picture, if the one before has arrived: there is never a queue.
  function forward() {
    if (!ready || inTransit || !socket || socket.readyState !== 1) return;
    send(PICTURE, [ready.captured / 1000], ready.jpeg);
    ready = null;
    inTransit = true;
    sent += 1;
  }

  // ---- the camera

  async function open() {
    if (opening || final || document.hidden || (track && track.readyState === "live")) return;
    opening = true;
    trouble = "starting";
    tell();
    try {
      if (!navigator.mediaDevices) throw new DOMException("", "NotSupportedError");
      stream = await navigator.mediaDevices.getUserMedia({ audio: false, video: WANTED });
      track = stream.getVideoTracks()[0];
      track.onended = () => { trouble = "ended"; tell(); };
      video.srcObject = stream;
      await video.play();
      trouble = "";
      seenAt = performance.now();
      report();
    } catch (error) {
      const causes = { NotAllowedError: "denied", NotFoundError: "none", OverconstrainedError: "small", NotReadableError: "taken" };
      trouble = causes[error.name] || "unable";
    }
    opening = false;
    tell();
  }

  async function adjust(wanted) {
    if (!track || !track.getCapabilities) return;
    const can = track.getCapabilities(), one = {};
    for (const [key, value] of Object.entries(wanted)) {
      const range = can[key];
      if (Array.isArray(range)) { if (range.includes(value)) one[key] = value; }
      else if (range && "max" in range) one[key] = Math.min(range.max, Math.max(range.min, value));
    }
    try { if (Object.keys(one).length) await track.applyConstraints({ advanced: [one] }); } catch (error) { /* it keeps its own */ }
    report();
  }

  function report() {
    const now = track && track.getSettings ? track.getSettings() : {};
    send(TRACK, [now.exposureTime || 0, now.iso || 0]);
  }

  // Two, since a picture may take longer to encode than the camera to take the next one.
  const idle = [0, 1].map(() => new Worker(`/${token}/encoder.js`));
  idle.forEach((encoder) => {
    encoder.onmessage = ({ data }) => {
      idle.push(encoder);
      if (!data.jpeg || data.captured <= newest) return; // a newer one was quicker
      newest = data.captured;
      ready = data;
      forward();
    };
  });

  // `captureTime`: when the camera took it, of the clock of performance.now(); not all browsers tell.
  async function frame(now, metadata) {
    video.requestVideoFrameCallback(frame);
    seenAt = performance.now();
    if (!idle.length || !socket) return;
    const captured = metadata.captureTime || metadata.presentationTime || now, encoder = idle.pop();
    try {
      const picture = window.VideoFrame ? new VideoFrame(video, { timestamp: 0 }) : await createImageBitmap(video); // the former is not copied
      encoder.postMessage({ picture, captured, quality: QUALITY }, [picture]);
    } catch (error) { idle.push(encoder); }
  }

  // ---- the screen stays on, and says in words what is wrong

  async function stayAwake() {
    try { if (navigator.wakeLock && !document.hidden && (!lock || lock.released)) lock = await navigator.wakeLock.request("screen"); } catch (error) { /* low battery */ }
  }

  function tell() {
    const open = socket && socket.readyState === 1, now = performance.now(), running = track && track.readyState === "live";
    let state = final || trouble;
    if (!state && !open) state = everOpen ? "lost" : failures > 2 ? "untrusted" : "connecting";
    if (!state && now - seenAt > STALLED_MS) state = "frozen";
    if (!state && now - arrivedAt > STALLED_MS) state = "slow";
    document.body.classList.toggle("wrong", Boolean(state) && state !== "starting" && state !== "connecting");
    document.body.classList.toggle("untrusted", state === "untrusted");
    const asks = ["elsewhere", "denied", "taken", "ended", "unable"].includes(state);
    document.body.classList.toggle("asks", asks);
    element("act").textContent = state === "elsewhere" ? texts.take : texts.again;
    element("state").textContent = texts[state || "running"];
    element("state").dataset.state = state || "running";
    element("figures").textContent = running && open ? `${video.videoWidth} × ${video.videoHeight}   ${rate}/s` : "";
  }

  element("act").onclick = () => { final = trouble = ""; track = null; wake(); };
  element("trust").firstElementChild.textContent = texts.certificate;

  function wake() {
    stayAwake();
    open();
    connect();
    tell();
  }

  document.addEventListener("visibilitychange", () => {
    if (!document.hidden) { wake(); return; }
    ready = null;
    if (socket) socket.close();
  });
  addEventListener("pagehide", () => { if (socket) socket.close(); });

  setInterval(report, ALIVE_MS);
  setInterval(() => {
    const now = performance.now();
    rate = Math.round(1000 * sent / Math.max(1, now - since));
    sent = 0;
    since = now;
    if (trouble !== "denied") wake();
    tell();
  }, RETRY_MS * 2);
  if (video.requestVideoFrameCallback && window.OffscreenCanvas) video.requestVideoFrameCallback(frame);
  else final = "unable";
  wake();
})();
