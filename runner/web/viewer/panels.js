// ---- Panels around the picture

function wordButton(text, act) {
    return element("button", {type: "button", className: "tidemark-word", textContent: text, onclick: act});
}

function choice(name, act) {
    const select = element("select", {ariaLabel: name, onchange: () => act(select.value)});
    return {select, element: element("label", {}, name, select)};
}

// Replaces the options only if they changed, so that an open list stays open.
function offer({select}, options, chosen) {
    const text = JSON.stringify(options);
    if (select.dataset.offered !== text)
        select.replaceChildren(...options.map(([value, label]) => element("option", {value, textContent: label})));
    select.dataset.offered = text;
    select.value = chosen;
}

// Shows all errors, each with its line and a mark under the place.
function showErrors(board, errors) {
    board.hidden = errors.length === 0;
    board.replaceChildren(...errors.flatMap(({text, line, mark}) =>
        [`${text}\n`, ...line ? [`    ${line}\n`] : [], ...mark ? [element("mark", {textContent: `    ${mark}\n`})] : []]));
}

// Sliders for the scene's knobs. One that the user is moving is left alone, since the program's values are
// older than the user's.
class Knobs {
    constructor(link) {
        this.link = link;
        this.element = element("div");
    }

    show(knobs) {
        const text = JSON.stringify(knobs);
        if (text === this.shown || this.element.contains(document.activeElement) && this.element.querySelector(":active"))
            return;
        this.shown = text;
        const mine = structuredClone(knobs);
        const panel = knobPanel(mine, knob => {
            this.shown = JSON.stringify(mine);
            this.link.send("turn", {name: knob.name, value: knob.value});
        });
        const turned = knobs.some(knob => knob.turned);
        this.element.replaceChildren(...knobs.length ? [element("h2", {textContent: "Knobs"}), panel] : [], ...turned ? [element(
            "div", {className: "tidemark-bar"}, wordButton("Reset", () => this.link.send("reset all")),
            wordButton("Copy as --set", () => this.link.send("copy knobs")))] : []);
    }
}

// A field for each #define and const that is a number. Leaving the field compiles it.
class Definitions {
    constructor(link) {
        this.link = link;
        this.element = element("div");
    }

    show(definitions) {
        const text = JSON.stringify(definitions);
        if (text === this.shown)
            return;
        this.shown = text;
        const panel = element("div", {className: "tidemark-knobs"}, ...definitions.map(each => this.#row(each)));
        this.element.replaceChildren(...definitions.length ? [element("h2", {textContent: "Definitions"}), panel] : []);
    }

    #row({name, value, whole, held}) {
        const field = element("input", {type: "number", className: "tidemark-number", step: whole ? 1 : "any", value, ariaLabel: name,
                                        onchange: () => this.link.send("define", {name, value: this.#text(field, whole)})});
        const back = wordButton("Reset", () => this.link.send("undefine", {name}));
        back.hidden = !held;
        return element("div", {className: "tidemark-knob"}, element("span", {textContent: name}), field, back);
    }

    // Adds a decimal point if the file has one: without it GLSL reads an integer.
    #text({value}, whole) { return whole || /[.e]/.test(value) ? value : `${value}.0`; }
}

