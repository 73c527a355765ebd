// ---- A scene drawn by the program

const SPEEDS = [-1, 0.1, 0.25, 0.5, 1, 2, 4];

class Remote {
    number = 0; // of the picture shown
    state = {size: [16, 9], keyboard: false, everyMove: false, camera: false, pictures: [], large: null, lens: null};
    arrivals = []; // times of pictures in the last second

    constructor(div) {
        this.div = Object.assign(div, {tidemark: this}); // for test scripts
        this.div.dataset.state = "connecting";
        this.link = new Link({onText: text => this.#hear(text), onPicture: (head, file) => this.#see(head, file),
                              onEnd: reason => this.#end(reason)});
        this.#build();
        const {canvas, link} = this;
        this.around = new Surroundings(canvas, link, () => this.state.size, () => this.state.keyboard); // before the scene's mouse
        this.around.onCommand = () => this.#press(67);
        sendPointer(canvas, link, () => this.state.size, () => this.state.everyMove || this.state.lens !== null);
        sendKeys(canvas, link, () => this.state.keyboard, () => this.toggleFullScreen());
        document.addEventListener("visibilitychange", () => this.#tellSeen());
        setInterval(() => this.#showCosts(), 1000); // once a second, so that the numbers can be read
        if (!this.around.inside) // an editor keeps the focus
            canvas.focus();
    }

    #build() {
        const {link} = this, ask = wanted => () => link.send(wanted);
        this.canvas = element("canvas", {tabIndex: 0, ariaLabel: "The scene"});
        this.errors = element("pre", {className: "tidemark-errors", hidden: true, role: "alert"});
        this.picture = element("div", {className: "tidemark-picture"}, this.canvas, this.errors);
        this.bar = new TimeBar({restart: ask("restart"), togglePause: ask("pause"), seek: seconds => link.send("seek", {seconds}),
                                toggleFullScreen: () => this.toggleFullScreen()}, false);
        this.pass = choice("Show", value => link.send("show", {picture: value === "" ? null : Number(value)}));
        this.speed = choice("Speed", value => link.send("speed", {speed: Number(value)}));
        this.copy = wordButton("Copy command", () => this.#press(67));
        this.camera = wordButton("Reset camera", () => this.#press(82, [16])); // Ctrl+R records
        this.loop = {from: wordButton("A", () => this.#loop("from")), to: wordButton("B", () => this.#loop("to"))};
        this.stay = wordButton("Stop here", ask("give up seek"));
        this.knobs = new Knobs(link);
        this.definitions = new Definitions(link);
        this.lenses = new Lenses(link);
        this.steer = wordButton("Take control", ask("steer"));
        this.status = element("output", {className: "tidemark-status"});
        this.notice = element("pre", {className: "tidemark-message", hidden: true});
        const more = element("div", {className: "tidemark-bar"}, this.pass.element, this.lenses.element, this.loop.from, this.loop.to, this.speed.element,
                             this.stay, this.copy, this.camera);
        this.fields = element("fieldset", {disabled: true}, this.bar.element, more, this.knobs.element, this.definitions.element);
        this.div.append(this.picture, this.lenses.legend, element("div", {className: "tidemark-bar"}, this.steer, this.status),
                        this.notice, this.fields);
    }

    // Sends a key of the window, whether or not the scene reads the keyboard.
    #press(code, others = []) {
        const held = this.state.keyboard ? [17, ...others, code] : [code]; // with Ctrl the window gets it
        held.forEach(each => this.link.send("keydown", {code: each}));
        held.reverse().forEach(each => this.link.send("keyup", {code: each}));
    }

    #hear({state, title, steering, clipboard}) {
        this.div.dataset.state = "running";
        if (state)
            this.#show(state);
        if (title !== undefined)
            document.title = this.title = title;
        if (title !== undefined && this.head)
            this.around.tellPicture(this.head, title);
        if (steering)
            this.steering = steering;
        if (clipboard !== undefined && !this.around.takeCommand(clipboard))
            this.#copied(clipboard);
        this.#showStatus();
    }

    #show(state) {
        this.state = state;
        const {pictures, large, time, errors, knobs, definitions, lenses, lens} = state;
        showErrors(this.errors, errors);
        this.#offerPasses();
        this.#showTime(time);
        this.camera.hidden = !state.camera;
        this.pass.element.hidden = pictures.length < 2 && large === null;
        this.knobs.show(knobs);
        this.definitions.show(definitions);
        this.lenses.show(lenses, lens);
    }

    // Sets or clears an end of the time loop between A and B.
    #loop(end) {
        const {from, to} = this.state.time;
        this.link.send("loop", {from, to, [end]: this.state.time[end] === null ? this.head?.seconds ?? 0 : null});
    }

    #showTime(time) {
        for (const [end, letter, verb] of [["from", "A", "start"], ["to", "B", "end"]]) {
            const at = time[end] === null ? null : `${time[end].toFixed(2)} s`;
            const words = at === null ? `Set the ${verb} of a time loop here` : `Clear the ${verb} of the time loop at ${at}`;
            Object.assign(this.loop[end], {textContent: at === null ? letter : `${letter} ${at}`, title: words, ariaLabel: words});
        }
        offer(this.speed, SPEEDS.filter(speed => speed > 0 || time.turnsBack).map(speed => [speed, `${speed}×`]), time.speed);
        this.speed.element.hidden = !time.hasSpeed;
        this.stay.hidden = !time.stepping; // stepping through the frames before the target frame
        if (this.head)
            this.bar.show(this.#moment(), time.paused, false);
    }

    // Adds each pass's time if the driver measures it.
    #offerPasses() {
        const {pictures, large} = this.state, costs = this.head?.costs ?? [];
        const label = (name, i) => costs[i] == null ? name : `${name} (${costs[i].toFixed(1)} ms)`;
        offer(this.pass, [["", "the scene"], ...pictures.map((name, i) => [i, label(name, i)])], large ?? "");
    }

    #showCosts() {
        this.#offerPasses();
        if (this.head)
            this.status.title = `drawn in ${this.head.draw.toFixed(1)} ms, encoded in ${this.head.encode.toFixed(1)} ms`;
    }

    async #see(head, bytes) {
        const bitmap = await createImageBitmap(new Blob([bytes], {type: "image/jpeg"}));
        if (head.number > this.number) {
            this.number = head.number;
            this.head = head;
            this.#draw(bitmap);
        }
        bitmap.close();
        this.#tellSeen();
    }

    #draw(bitmap) {
        const {canvas, picture} = this, {width, height} = bitmap;
        if (canvas.width !== width || canvas.height !== height) {
            [canvas.width, canvas.height] = [width, height];
            picture.style.setProperty("--ratio", width / height);
        }
        canvas.getContext("2d").drawImage(bitmap, 0, 0);
        const now = performance.now();
        this.arrivals = [...this.arrivals.filter(then => now - then < 1000), now];
        this.bar.show(this.#moment(), this.state.time?.paused, false);
        this.around.tellPicture(this.head, this.title);
    }

    // A hidden page acknowledges nothing, so no pictures are drawn for it.
    #tellSeen() {
        if (!document.hidden && this.number > 0)
            this.link.send("seen", {number: this.number});
    }

    #moment() { return {time: this.head.seconds, frame: this.head.frame, rate: this.arrivals.length}; }

    #showStatus() {
        const {you, viewers} = this.steering ?? {you: false, viewers: 1};
        this.fields.disabled = !you;
        this.steer.hidden = you;
        const others = viewers - 1, watch = others === 1 ? "1 other viewer" : `${others} other viewers`;
        this.status.textContent = [this.title, you ? others ? `in control, ${watch}` : "" : `watching, ${watch}`].filter(Boolean).join(" · ");
    }

    async #copied(text) {
        this.notice.textContent = text;
        this.notice.hidden = false;
        // the text is shown, so it can be copied by hand
        await navigator.clipboard?.writeText(text).catch(() => {});
    }

    #end(reason) {
        this.div.dataset.state = "ended";
        this.fields.disabled = true;
        this.steer.hidden = true;
        this.status.textContent = "";
        this.notice.hidden = false;
        this.notice.textContent = !Link.query ? "Access denied: open the full address, including its token." :
            `The connection was lost${reason ? `: ${reason}` : ""}. Reload the page once the program runs again.`;
    }

    toggleFullScreen() {
        if (document.fullscreenElement)
            document.exitFullscreen();
        else
            this.picture.requestFullscreen();
    }
}

new Remote(document.querySelector(".tidemark"));
})();
