"use strict";
document.documentElement.classList.add("script");

// The number that a cell begins with, behind signs such as < or ±; NaN if it is a text.
const numberIn = (text) => {
  const found = /^[<>≤≥~±\s]*([-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)/i.exec(text.trim());
  return found ? Number(found[1].replace("−", "-")) : NaN;
};

// Rows in the order of a column: numbers by value, texts after them; once more: the other way; empty cells last.
const sortBy = (heading) => {
  const body = heading.closest("table").tBodies[0];
  const up = heading.getAttribute("aria-sort") !== "ascending";
  const keyed = [...body.rows].map((row) => {
    const text = row.cells[heading.cellIndex].textContent.trim();
    return { row, text, value: numberIn(text) };
  });
  const order = (a, b) => {
    if (!a.text || !b.text) return Number(!a.text) - Number(!b.text);
    const texts = Number(isNaN(a.value)) - Number(isNaN(b.value));
    if (texts) return texts;
    const ahead = isNaN(a.value) ? a.text.localeCompare(b.text) : a.value - b.value;
    return up ? ahead : -ahead;
  };
  body.append(...keyed.sort(order).map((one) => one.row));
  for (const other of heading.parentElement.cells) other.removeAttribute("aria-sort");
  heading.setAttribute("aria-sort", up ? "ascending" : "descending");
};

// A group of buttons, each with the kind of rows that it shows in data-show; "" shows all.
const filterBy = (pressed) => {
  const group = pressed.closest("[data-filter]");
  for (const one of group.querySelectorAll("button")) one.setAttribute("aria-pressed", String(one === pressed));
  const kind = pressed.dataset.show;
  for (const row of document.querySelectorAll(`#${group.dataset.filter} [data-kind]`)) {
    row.hidden = Boolean(kind) && row.dataset.kind !== kind;
  }
};

document.addEventListener("DOMContentLoaded", () => {
  for (const heading of document.querySelectorAll("thead th")) {
    const button = document.createElement("button");
    button.append(...heading.childNodes);
    button.addEventListener("click", () => sortBy(heading));
    heading.append(button);
  }
  for (const button of document.querySelectorAll("[data-filter] button")) {
    button.addEventListener("click", () => filterBy(button));
  }
  for (const picture of document.querySelectorAll(".printed")) picture.open = false;  // the live figure shows it
  const hint = new ResizeObserver((entries) => {
    for (const { target } of entries) target.classList.toggle("more", target.scrollWidth > target.clientWidth + 1);
  });
  for (const box of document.querySelectorAll(".scroll")) hint.observe(box);
  const menu = document.querySelector("nav.bar details");
  menu.addEventListener("click", (event) => { if (event.target.closest("a")) menu.open = false; });
});

// Paper cannot unfold anything.
let unfolded = [];
window.addEventListener("beforeprint", () => {
  unfolded = [...document.querySelectorAll("main details:not([open])")];
  for (const one of unfolded) one.open = true;
});
window.addEventListener("afterprint", () => { for (const one of unfolded) one.open = false; });
