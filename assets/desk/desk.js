// Keeps a page up to date, and lets its parts take turns on a projector (?big).
"use strict";
const body = document.body;
const every = Number(body.dataset.every || 0);
const TURN = 10; // s
const big = new URLSearchParams(location.search).has("big");
let mark = "";
let shown = 0;

function turn(by) {
    const pages = [...document.querySelectorAll(".page")];
    if (!big || !pages.length) return;
    shown = (shown + by) % pages.length;
    pages.forEach((page, i) => page.classList.toggle("shown", i === shown));
}

async function look() {
    try {
        const answer = await fetch(location.href, { headers: mark ? { "If-None-Match": mark } : {}, cache: "no-store" });
        if (answer.status === 200) {
            mark = answer.headers.get("ETag") || "";
            const fresh = new DOMParser().parseFromString(await answer.text(), "text/html").querySelector("main");
            const main = document.querySelector("main");
            if (fresh && fresh.innerHTML !== main.dataset.source) {
                const source = fresh.innerHTML;
                main.replaceWith(document.adoptNode(fresh));
                fresh.dataset.source = source;
                turn(0);
            }
        }
        body.classList.toggle("lost", answer.status >= 400);
    } catch (error) {
        body.classList.add("lost");
    }
}

async function lookAlways() {
    await look();
    setTimeout(lookAlways, 1000 * every);
}

body.classList.toggle("big", big);
document.querySelector("main").dataset.source = document.querySelector("main").innerHTML;
turn(0);
setInterval(() => turn(1), 1000 * TURN);
if (every && location.protocol !== "file:") setTimeout(lookAlways, 1000 * every);
