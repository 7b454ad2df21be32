"use strict";
// Search, filters, copying and the theme. Without this file every page can still be read.
(() => {
  const $ = (selector, root = document) => root.querySelector(selector);
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  // --- theme ---------------------------------------------------------------------------------
  const theme = $("#theme");
  const root = document.documentElement;
  const stored = (value) => {
    try {
      if (value !== undefined) localStorage.setItem("xsec-theme", value);
      return localStorage.getItem("xsec-theme");
    } catch { return null; } // pages from the file system may have no storage
  };
  const dark = () => root.dataset.theme
    ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  const named = () => {
    theme.textContent = dark() ? "light" : "dark";
    theme.title = `switch to ${theme.textContent} colours`;
  };
  if (["light", "dark"].includes(stored())) root.dataset.theme = stored();
  theme.hidden = false;
  theme.addEventListener("click", () => { root.dataset.theme = dark() ? "light" : "dark"; stored(root.dataset.theme); named(); });
  named();

  // --- copying -------------------------------------------------------------------------------
  const copied = async (text) => {
    try { await navigator.clipboard.writeText(text); return true; } catch { /* the older way is left */ }
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  };
  for (const button of all(".copy")) {
    button.hidden = false;
    button.addEventListener("click", async () => {
      button.textContent = await copied($("code", button.parentElement).textContent) ? "copied" : "select and copy";
      button.focus();
      setTimeout(() => { button.textContent = "copy"; }, 2000);
    });
  }

  // --- formulas that are too wide can be scrolled by keyboard ----------------------------------
  const SMALLEST = 0.75; // what is smaller is hard to read: from there on it is scrolled
  const reachable = () => {
    for (const box of all(".formula")) { box.style.removeProperty("--fit"); box.classList.remove("tiny"); }
    const over = all(".formula").filter((box) => box.scrollWidth > box.clientWidth).map((box) => [box, box.clientWidth / box.scrollWidth]);
    for (const [box, fit] of over) box.style.setProperty("--fit", Math.max(SMALLEST, 0.98 * fit).toFixed(3));
    const wide = all(".formula").map((box) => [box, box.scrollWidth > box.clientWidth]);
    for (const [box, over] of wide) {
      if (over) box.tabIndex = 0; else box.removeAttribute("tabindex");
    }
  };
  const revealed = () => { // what differs is in sight, however wide the formula
    const marks = all(".formula").filter((box) => box.scrollWidth > box.clientWidth).map((box) => [box, $(".gone, .new, .gap", box)]);
    const places = marks.filter(([, mark]) => mark).map(([box, mark]) => {
      const [outer, inner] = [box.getBoundingClientRect(), mark.getBoundingClientRect()];
      return [box, inner.right > outer.right ? inner.left - outer.left - outer.width / 2 : 0];
    });
    for (const [box, left] of places) box.scrollLeft += left;
  };
  const fitted = () => { // on paper nothing can be scrolled: 40 rem are about the width of a sheet
    for (const box of all(".formula")) box.style.removeProperty("--fit");
    const sheet = 40 * parseFloat(getComputedStyle(root).fontSize) / 0.75; // on paper letters are smaller by this
    const wide = all(".formula").map((box) => [box, Math.max(...all("math", box).map((m) => m.getBoundingClientRect().width), 1)]);
    for (const [box, width] of wide) {
      box.style.setProperty("--fit", Math.min(1, sheet / width).toFixed(3));
      box.classList.toggle("tiny", sheet < 0.6 * width);
    }
  };
  let waiting = 0;
  addEventListener("resize", () => { clearTimeout(waiting); waiting = setTimeout(reachable, 200); });
  addEventListener("load", reachable);
  addEventListener("load", revealed);
  addEventListener("beforeprint", fitted);
  addEventListener("afterprint", reachable);

  // --- search --------------------------------------------------------------------------------
  const search = $("#search");
  if (!search) return;
  const form = search.form;
  const shown = $("#shown");
  const wordsOf = () => search.value.toLowerCase().split(/\s+/).filter(Boolean);
  const holds = (text, words) => words.every((word) => text.includes(word));
  form.hidden = false;
  form.addEventListener("submit", (event) => event.preventDefault());
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "/" && !event.target.closest("input, textarea")) { event.preventDefault(); search.focus(); search.select(); }
    if (event.key === "Escape" && event.target === search) { search.value = ""; search.dispatchEvent(new Event("input")); }
  });

  const entries = all("article.entry");
  if (!entries.length) { overall(); return; }

  const boxes = all("[name=verdict]");
  const apply = () => {
    const words = wordsOf();
    const wanted = boxes.filter((b) => b.checked).flatMap((b) => b.value.split(" "));
    let count = 0;
    for (const entry of entries) {
      const fits = (!wanted.length || wanted.includes(entry.dataset.verdict)) && holds(entry.dataset.find, words);
      entry.hidden = !fits;
      count += fits;
    }
    for (const section of all("section.section")) section.hidden = !$("article.entry:not([hidden])", section);
    const noun = shown.dataset.of || "entries";
    shown.textContent = count === entries.length ? `${count} ${noun}` : `${count} of ${entries.length} ${noun} shown`;
    $("#nothing").hidden = count > 0;
    reachable();
  };
  const reach = () => { // a link leads to its entry, whatever is filtered
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const proof = target && $("details.derivation", target); // who comes by a link wants the derivation as well
    if (proof && target.matches("article.entry")) proof.open = true;
    if (target && (target.hidden || target.closest("[hidden]"))) {
      search.value = "";
      boxes.forEach((b) => { b.checked = false; });
      apply();
      target.scrollIntoView();
    }
  };
  const asked = new URLSearchParams(location.search);
  boxes.forEach((b) => { b.checked = asked.getAll("verdict").some((word) => b.value.split(" ").includes(word)); });
  search.value = asked.get("q") || "";
  search.addEventListener("input", apply);
  boxes.forEach((b) => b.addEventListener("change", apply));
  addEventListener("hashchange", reach);
  const unfold = $("#unfold");
  unfold.addEventListener("click", () => {
    const open = unfold.textContent.startsWith("open");
    all("details.derivation").forEach((d) => { d.open = open; });
    unfold.textContent = open ? "close all derivations" : "open all derivations";
  });
  apply();
  reach();

  // --- on the index: through all sources -----------------------------------------------------
  function overall() {
    const hits = $("#hits");
    const MOST = 50;
    const find = () => {
      const words = wordsOf();
      const found = words.length ? window.RECORD.filter((row) => holds(row[4], words)) : [];
      hits.replaceChildren(...found.slice(0, MOST).map(([id, title, verdict, href]) => {
        const line = document.createElement("li");
        const link = document.createElement("a");
        const badge = document.createElement("span");
        link.href = href;
        link.textContent = `${id} ${title}`;
        badge.className = `verdict v-${verdict}`;
        badge.textContent = verdict.replace("-", " ");
        line.append(link, badge);
        return line;
      }));
      const more = found.length > MOST ? `, the first ${MOST} are listed` : "";
      shown.textContent = words.length ? `${found.length} found${more}` : "";
    };
    search.addEventListener("input", find);
    find();
  }
})();
