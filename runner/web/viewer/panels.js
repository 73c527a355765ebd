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


// The list of lenses, the fields for a line and a variable, and the legend of the lens on show.
class Lenses {
    constructor(link) {
        this.link = link;
        this.choices = [];
        this.asked = null; // the last request, until a state shows it
        this.list = choice("Lens", () => this.#ask());
        this.place = element("input", {type: "text", className: "tidemark-number", ariaLabel: "Line of the lens", placeholder: "line",
                                       title: "LINE or FILE:LINE", onchange: () => this.#ask()});
        this.variable = element("input", {type: "text", className: "tidemark-number", ariaLabel: "Variable of the lens",
                                          placeholder: "variable", onchange: () => this.#ask()});
        this.element = element("span", {className: "tidemark-lenses"}, this.list.element, this.place, this.variable);
        this.legend = element("div", {className: "tidemark-legend", hidden: true, role: "status"});
    }

    // Asks for the lens once it has the line that it needs.
    #ask() {
        const name = this.list.select.value, {takesLine, needsLine, second} = this.#fields(name);
        const line = takesLine ? this.place.value.trim() : "", rest = line && second ? this.variable.value.trim() : "";
        if (!line && needsLine)
            return this.place.focus();
        this.link.send("lens", {lens: [name, line, rest].filter(Boolean).join(":")});
        this.asked = {name, until: performance.now() + 5000};
    }

    // Shows the fields of the lens, and returns its choice.
    #fields(name) {
        const choice = this.choices.find(each => each.name === name) ?? {};
        this.place.hidden = !choice.takesLine;
        this.variable.hidden = !choice.second;
        this.variable.placeholder = choice.second ?? "";
        return choice;
    }

    show({choices, chosen, place, variable}, lens) {
        this.element.hidden = choices.length === 0;
        const shown = chosen === null ? "" : choices[chosen].name;
        if (this.asked?.name === shown || performance.now() > this.asked?.until)
            this.asked = null;
        const waits = this.element.contains(document.activeElement) && !this.place.hidden; // the user is typing
        if (!waits && !this.asked) { // a state from before the request would undo the choice
            this.choices = choices;
            offer(this.list, [["", "off"], ...choices.map(({name}) => [name, name])], shown);
            for (const [i, {says, refusal}] of choices.entries())
                this.list.select.options[i + 1].title = refusal || says;
            this.#fields(this.list.select.value);
            [this.place.value, this.variable.value] = [place, variable];
        }
        this.#showLegend(lens);
    }

    #showLegend(lens) {
        this.legend.hidden = !lens;
        if (!lens)
            return;
        const {title, basis, bar, low, high, mark, pointer, entries, refusal, progress} = lens;
        const scale = element("div", {className: "tidemark-scale"});
        scale.style.background = `linear-gradient(to right, ${bar.join(", ")})`;
        if (mark !== null) {
            const at = element("span", {className: "tidemark-mark"});
            at.style.left = `${100 * mark}%`;
            scale.append(at);
        }
        const box = colour => {
            const made = element("span", {className: "tidemark-box"});
            made.style.background = colour;
            return made;
        };
        const row = ({box: colour, words}) => element("span", {}, ...colour ? [box(colour)] : [], words);
        this.legend.replaceChildren(...refusal ? [element("strong", {textContent: refusal})] : [
            element("strong", {textContent: title}), element("span", {textContent: basis}),
            ...bar.length > 1 ? [element("div", {className: "tidemark-ends"}, low, scale, high)] : [],
            ...entries.map(row), element("output", {className: "tidemark-value", textContent: pointer})],
            ...progress ? [element("em", {textContent: progress})] : []);
    }
}
