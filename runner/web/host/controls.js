
// ---- Controls

function element(name, attributes = {}, ...children) {
    const made = Object.assign(document.createElement(name), attributes);
    made.append(...children);
    return made;
}

// Icons are drawn, since not every machine has such characters.
const ICONS = {
    restart: "M3 3h2v10H3zM13 3v10L6 8z", play: "M4 2l9 6-9 6z", pause: "M4 3h3v10H4zM9 3h3v10H9z",
    full: "M2 2h5v2H4v3H2zM9 2h5v5h-2V4H9zM2 9h2v3h3v2H2zM12 9h2v5H9v-2h3z",
    silent: "M2 6h3l4-4v12l-4-4H2zM11 6l4 4-1 1-4-4zM14 5l1 1-4 4-1-1z",
    audible: "M2 6h3l4-4v12l-4-4H2zM11 5c2 1 2 5 0 6zM12 2c5 2 5 10 0 12v-1c3-3 3-7 0-10z",
};

function label(of, text, icon) {
    if (of.title !== text)
        Object.assign(of, {title: text, ariaLabel: text,
                           innerHTML: `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${ICONS[icon]}"/></svg>`});
}

function button(text, icon, act) {
    const made = element("button", {type: "button", onclick: act});
    label(made, text, icon);
    return made;
}

// The bar below the picture: restart, pause, time, sound, full screen.
class TimeBar {
    constructor({restart, togglePause, seek, toggleSound, toggleFullScreen}, hasSound) {
        this.pause = button("Pause", "pause", togglePause);
        this.time = element("input", {type: "range", className: "tidemark-time", min: 0, max: 10, step: "any", value: 0,
                                      ariaLabel: "Time", oninput: () => seek(Number(this.time.value))});
        this.clock = element("output", {className: "tidemark-clock"});
        this.sound = button("Sound on", "silent", toggleSound);
        this.sound.hidden = !hasSound;
        this.element = element("div", {className: "tidemark-bar"}, button("Restart", "restart", restart), this.pause, this.time,
                               this.clock, this.sound, button("Full screen", "full", toggleFullScreen));
    }

    show({time, frame, rate}, paused, audible) {
        while (Number(this.time.max) < time)
            this.time.max = 2 * this.time.max; // the range doubles when time reaches its end
        this.time.value = time;
        this.clock.textContent = `${time.toFixed(2)} s \u00b7 frame ${frame} \u00b7 ${rate.toFixed(0)} fps`;
        label(this.pause, paused ? "Play" : "Pause", paused ? "play" : "pause");
        label(this.sound, audible ? "Sound off" : "Sound on", audible ? "audible" : "silent");
    }
}

const HEX = 16;
const byteOf = value => Math.round(255 * Math.min(1, Math.max(0, value)));
const hexOf = colour => `#${colour.map(value => byteOf(value).toString(HEX).padStart(2, "0")).join("")}`;
const colourOf = hex => [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), HEX) / 255);

// Returns a knob's widgets: a colour field, a check box if there are two values, sliders if there is a range,
// or number fields. Calls `changed` with the knob.
function knobWidgets(knob, changed) {
    const turn = (i, value) => {
        knob.value[i] = value;
        changed(knob);
    };
    if (knob.colour)
        return [element("input", {type: "color", value: hexOf(knob.value), ariaLabel: knob.name, oninput: event => {
            knob.value = colourOf(event.target.value);
            changed(knob);
        }})];
    const {low, high, step} = knob;
    if (low && step && knob.value.length === 1 && high[0] - low[0] === step[0])
        return [element("input", {type: "checkbox", checked: knob.value[0] === high[0], ariaLabel: knob.name,
                                  onchange: event => turn(0, event.target.checked ? high[0] : low[0])})];
    return knob.value.map((value, i) => {
        const number = element("output", {textContent: value});
        const field = element("input", {type: low ? "range" : "number", step: step?.[i] ?? (knob.whole ? 1 : "any"),
                                        min: low?.[i] ?? "", max: high?.[i] ?? "", ariaLabel: knob.name, oninput: () => {
            if (field.value === "")
                return;
            number.textContent = Number(Number(field.value).toPrecision(6));
            turn(i, Number(field.value));
        }});
        field.value = value; // set after its range and step, which limit it
        return element("span", {className: "tidemark-component"}, field, ...low ? [number] : []);
    });
}

function knobPanel(knobs, changed) {
    return element("div", {className: "tidemark-knobs"}, ...knobs.map(knob =>
        element("div", {className: "tidemark-knob"}, element("span", {textContent: knob.name}),
                ...knobWidgets(knob, changed))));
}
