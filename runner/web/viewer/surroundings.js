// ---- The page within another page, such as an editor's preview

// Sends the numbers of each picture and the editor's shortcuts to the page around this one; answers its requests for the capture command
// and for a pixel. Only a page that --frame-ancestor names can frame this one.
class Surroundings {
    constructor(canvas, link, size, sceneReads) {
        Object.assign(this, {canvas, link, size, told: -1000, timer: null, wantsCommand: false});
        this.inside = window.parent !== window;
        if (!this.inside)
            return;
        window.addEventListener("message", ({source, data}) => source === window.parent && this.#answer(data?.tidemark));
        canvas.addEventListener("pointermove", event => this.pixel = placeIn(canvas, event, size()));
        canvas.addEventListener("pointerdown", event => this.picking && this.#pick(event), {capture: true});
        window.addEventListener("keydown", event => this.#key(event, sceneReads), {capture: true});
    }

    #post(what, values = {}) { window.parent.postMessage({tidemark: what, ...values}, "*"); } // contains no secrets

    // Posts four times a second at most; the last values always arrive.
    tellPicture({seconds, frame, draw}, title) {
        if (!this.inside)
            return;
        this.picture = {seconds, frame, draw, size: this.size(), bad: Number(/(\d+) pixels? not finite/.exec(title)?.[1] ?? 0)};
        this.timer ??= setTimeout(() => {
            this.timer = null;
            this.told = performance.now();
            this.#post("picture", this.picture);
        }, Math.max(0, this.told + 250 - performance.now()));
    }

    // Returns whether the copied text was for the page around this one.
    takeCommand(text) {
        if (!this.wantsCommand)
            return false;
        this.wantsCommand = false;
        this.#post("command", {text});
        return true;
    }

    #answer(wanted) {
        if (wanted === "command") {
            this.wantsCommand = true;
            this.onCommand?.();
        } else if (wanted === "pick") {
            this.#setPicking(true);
            this.canvas.focus();
        } else if (wanted === "cancel") {
            this.#setPicking(false);
        }
    }

    #setPicking(picking) {
        this.picking = picking;
        this.canvas.style.cursor = picking ? "crosshair" : "";
    }

    #pick(event) {
        event.preventDefault();
        event.stopImmediatePropagation(); // the scene's mouse stays where it is
        const [x, y] = placeIn(this.canvas, event, this.size());
        this.#setPicking(false);
        this.#post("pick", {x, y});
    }

    // Esc ends the choice of a pixel, T traces the one under the pointer; the editor gets its own shortcuts.
    #key(event, sceneReads) {
        const {key, code, keyCode, ctrlKey, altKey, metaKey, shiftKey} = event;
        if (key === "Escape" && this.picking) {
            this.#setPicking(false);
            this.#post("pick");
        } else if (ctrlKey || altKey || metaKey || /^F\d+$/.test(key)) {
            if (!/^[acvxz]$/i.test(key) || event.target === this.canvas)
                this.#post("key", {key, code, keyCode, ctrlKey, altKey, metaKey, shiftKey, repeat: event.repeat});
        } else if (key === "t" && event.target === this.canvas && !sceneReads() && this.pixel) {
            this.#post("trace", {x: this.pixel[0], y: this.pixel[1]});
        }
    }
}

