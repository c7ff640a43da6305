import "./style.css";
import { blobLoaded } from "./data/blob";
import { decoderReady } from "./data/mesh";
import { readReport, type Report } from "./data/report";
import { h } from "./dom";
import { galleryPage } from "./pages/gallery";
import { objectPage } from "./pages/object";
import { overviewPage } from "./pages/overview";
import { replayPage } from "./pages/replay";
import { type Page, parseRoute } from "./router";

const KINDS = { run: "Training run", perturbed: "Perturbed objects", objects: "Scored objects" };

function message(text: string): Page {
  return {
    title: "",
    element: h(
      "main",
      { class: "message" },
      h("h1", { tabindex: -1 }, text),
      h("p", {}, h("a", { href: "#/" }, "Overview")),
    ),
  };
}

// This program runs before the browser has read the geometry, which lies behind it. The overview and the gallery show
// objects as they arrive; other pages need all of theirs at once.
function isEarly(): boolean {
  const { page } = parseRoute(location.hash);
  return !blobLoaded() && (page === "object" || page === "replay");
}

function pageFor(report: Report): Page {
  const route = parseRoute(location.hash);
  if (isEarly()) return message("Loading the report …");
  if (route.page === "gallery") return galleryPage(report);
  if (route.page === "overview") return overviewPage(report);
  if (route.index >= report.objects.length) return message(`This report has no object ${route.index}.`);
  return route.page === "replay" ? replayPage(report, route.index) : objectPage(report, route.index);
}

function header(report: Report): { element: HTMLElement; mark: () => void } {
  const links = [h("a", { href: "#/" }, "Overview")];
  if (report.objects.length) links.push(h("a", { href: "#/gallery" }, "Objects"));
  const mark = () => {
    const page = parseRoute(location.hash).page;
    links.forEach((link, i) => {
      if ((i === 0) === (page === "overview")) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    });
  };
  const name = h(
    "p",
    { class: "name" },
    h("a", { href: "#/" }, h("b", {}, report.title || "antigrasp"), h("span", {}, KINDS[report.kind] ?? "")),
  );
  return { element: h("header", { class: "top" }, name, h("nav", { "aria-label": "Pages" }, ...links)), mark };
}

function start(): void {
  const app = document.getElementById("app")!;
  const report = readReport(document.getElementById("antigrasp-report")?.textContent ?? "");
  if (typeof report === "string") {
    app.replaceChildren(h("main", { class: "message" }, h("h1", {}, report)));
    return;
  }
  const top = header(report);
  const holder = h("div", { class: "holder" });
  app.replaceChildren(
    h(
      "a",
      {
        class: "skip",
        href: "#",
        onclick: (event: Event) => {
          event.preventDefault();
          holder.querySelector<HTMLElement>("h1")?.focus();
        },
      },
      "Skip to content",
    ),
    top.element,
    holder,
  );

  let current: Page | null = null;
  let waits = false;
  const show = (navigated: boolean) => {
    current?.dispose?.();
    waits = isEarly();
    const page = pageFor(report);
    current = page;
    holder.replaceChildren(page.element);
    document.title = page.title ? `${page.title} – ${report.title}` : report.title || "antigrasp";
    top.mark();
    if (navigated) {
      window.scrollTo(0, 0);
      page.element.querySelector<HTMLElement>("h1")?.focus({ preventScroll: true });
    }
    page.mounted?.();
  };
  window.addEventListener("hashchange", () => show(true));
  document.addEventListener("DOMContentLoaded", () => {
    if (waits) show(false);
  });
  // Pages that draw objects need the decoder; it is there after a few milliseconds, or never (then they say so).
  decoderReady.then(
    () => show(false),
    () => show(false),
  );
}

start();
