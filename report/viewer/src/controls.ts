import { h } from "./dom";

export interface Slider {
  element: HTMLElement;
  input: HTMLInputElement;
  /** Sets value and text without telling `changed`. */
  set: (value: number) => void;
}

let sliders = 0;

/** A labelled slider that says its value in words, to eyes and to screen readers. */
export function slider(
  label: string,
  range: { min: number; max: number; step: number; value: number },
  text: (value: number) => string,
  changed: (value: number) => void,
): Slider {
  const id = `slider-${++sliders}`; // an output is labelable too: the label must name the input
  const output = h("output", { for: id }, text(range.value));
  const input = h("input", {
    type: "range",
    id,
    min: range.min,
    max: range.max,
    step: range.step,
    value: range.value,
    "aria-valuetext": text(range.value),
  });
  const say = () => {
    output.textContent = text(input.valueAsNumber);
    input.setAttribute("aria-valuetext", output.textContent);
  };
  input.addEventListener("input", () => {
    say();
    changed(input.valueAsNumber);
  });
  const set = (value: number) => {
    input.valueAsNumber = value;
    say();
  };
  return {
    element: h("div", { class: "slider" }, h("span", {}, h("label", { for: id }, label), output), input),
    input,
    set,
  };
}

export function tick(
  label: string,
  value: boolean,
  changed: (value: boolean) => void,
  className = "tick",
): HTMLLabelElement {
  const box = h("input", { type: "checkbox", checked: value, onchange: () => changed(box.checked) });
  return h("label", { class: className }, box, h("span", {}, label));
}

/** One of a few, all of them visible. */
export function radios<T extends string>(
  legend: string,
  value: T,
  options: [T, string][],
  changed: (value: T) => void,
): HTMLElement {
  const name = `radio-${legend.replace(/\W+/g, "-")}`;
  return h(
    "fieldset",
    { class: "chips" },
    h("legend", {}, legend),
    ...options.map(([key, text]) =>
      h(
        "label",
        { class: "chip" },
        h("input", { type: "radio", name, value: key, checked: key === value, onchange: () => changed(key) }),
        h("span", {}, text),
      ),
    ),
  );
}

export function choice<T extends string>(
  label: string,
  value: T,
  options: [T, string][],
  changed: (value: T) => void,
): HTMLElement {
  const select = h(
    "select",
    { onchange: () => changed(select.value as T) },
    ...options.map(([key, text]) => h("option", { value: key, selected: key === value }, text)),
  );
  return h("label", { class: "field" }, h("span", {}, label), select);
}
