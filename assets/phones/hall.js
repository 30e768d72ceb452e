// What a phone shows while it waits: its place, cheers and votes; its name and colour; and a screen that stays on.
"use strict";
window.hall = (send, press) => {
  const element = (id) => document.getElementById(id);
  const NAME = 0x10, COLOUR = 0x11, CHEER = 0x12, GAME = 0x13, ARENA = 0x14; // see phone_messages.py
  const COLOURS = ["#3ca0ff", "#ff9200", "#14e48c", "#ff90d6", "#ffec40", "#be8cff", "#5ae6ff", "#e2eeff"];
  const CHEER_MS = 1600, PRESS_MS = 150;
  const ITS_TURN = -1, LEFT_QUEUE = -2;
  let texts = {}, lock = null;

  // ---- the queue

  function dress(state, words) {
    texts = words;
    const waits = state.seat < 0 && state.before !== ITS_TURN;
    document.body.classList.toggle("waiting", waits);
    document.body.classList.toggle("left-queue", waits && state.before === LEFT_QUEUE);
    document.body.classList.toggle("seated", state.seat >= 0);
    const { before } = state;
    element("before").textContent = before === LEFT_QUEUE ? texts.page_idle : before === 0 ? texts.page_next
      : texts.page_before.replace("{count}", before);
    element("line").textContent = state.place || state.line;
    const [games, arenas] = document.querySelectorAll("#hall h2");
    games.textContent = texts.page_game;
    arenas.textContent = texts.page_arena;
    const [name, colour, hand] = document.querySelectorAll("#sheet label > span:first-child");
    name.textContent = texts.page_name;
    colour.textContent = texts.page_colour;
    hand.textContent = texts.page_hand;
    element("save").textContent = texts.page_save;
    if (!document.body.classList.contains("naming")) element("name").value = state.name;
  }

  function ballot(lists) {
    for (const [id, kind] of [["games", GAME], ["arenas", ARENA]]) {
      const box = element(id);
      const old = [...box.children].map((button) => button.textContent);
      if (old.join("\n") === lists[id].join("\n")) continue;
      box.replaceChildren(...lists[id].map((word, place) => {
        const button = document.createElement("button");
        button.textContent = word;
        button.addEventListener("click", () => {
          for (const other of box.children) other.classList.toggle("chosen", other === button);
          send([kind, place]);
        });
        return button;
      }));
    }
  }

  [...document.querySelectorAll(".cheer")].forEach((button, kind) => button.addEventListener("click", () => {
    if (button.classList.contains("spent")) return;
    send([CHEER, kind]);
    for (const one of document.querySelectorAll(".cheer")) one.classList.add("spent");
    setTimeout(() => { for (const one of document.querySelectorAll(".cheer")) one.classList.remove("spent"); }, CHEER_MS);
  }));
  element("again").addEventListener("click", () => {
    press("fire", true);
    setTimeout(() => press("fire", false), PRESS_MS);
  });

  // ---- the sheet: name, colour, hand

  function named({ name, refused }) {
    element("unkind").textContent = refused ? texts.page_unkind : "";
    document.body.classList.toggle("naming", refused);
    if (!refused) element("name").value = name;
  }

  element("colours").append(...COLOURS.map((colour, place) => {
    const button = document.createElement("button");
    button.type = "button";
    button.style.background = colour;
    button.addEventListener("click", () => {
      for (const other of element("colours").children) other.classList.toggle("chosen", other === button);
      send([COLOUR, place]);
    });
    return button;
  }));
  element("me").addEventListener("click", () => {
    element("unkind").textContent = "";
    element("awake").textContent = awake() ? texts.page_awake : texts.page_asleep;
    document.body.classList.toggle("naming");
  });
  element("sheet").addEventListener("submit", (event) => {
    event.preventDefault();
    element("name").blur();
    send([NAME, ...new TextEncoder().encode(element("name").value).slice(0, 48)]);
  });
  element("hand").addEventListener("click", () => {
    const left = document.body.classList.toggle("left");
    sessionStorage.setItem("left", left ? "1" : "");
  });
  document.body.classList.toggle("left", Boolean(sessionStorage.getItem("left")));

  // ---- a screen that stays on: by the wake lock where the page is secure, else as long as a silent video plays

  const video = element("video");
  const awake = () => Boolean(lock && !lock.released) || !video.paused;

  function stayAwake() {
    if (document.hidden || awake()) return;
    if (navigator.wakeLock) navigator.wakeLock.request("screen").then((granted) => { lock = granted; }, play);
    else play();
  }

  function play() {
    if (!video.src) load();
    const begun = video.play();
    if (begun) begun.catch(() => {}); // not before the page is touched and the video is there
  }

  // As a data address: some browsers play others from servers that send parts only.
  function load() {
    video.src = "data:,";
    const kind = video.canPlayType('video/mp4; codecs="avc1.42E01E, mp4a.40.2"') ? "mp4" : "webm";
    const reader = new FileReader();
    reader.onload = () => { video.src = reader.result; play(); };
    fetch(`${location.pathname.replace(/\/$/, "")}/awake.${kind}`).then((answer) => answer.blob()).then((blob) => reader.readAsDataURL(blob), () => {});
  }

  video.addEventListener("timeupdate", () => { if (video.currentTime > 1.5) video.currentTime = 0.1; }); // a video that loops lets some phones sleep
  addEventListener("pointerup", stayAwake);
  document.addEventListener("visibilitychange", stayAwake);

  return { dress, ballot, named };
};
