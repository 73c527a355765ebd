
// ---- The figure: a scene on a page

const LAST_FRAME = 2 ** 31 - 2; // iFrame is an int, and one more frame must follow

// Parses `time=2.5&frame=3&size=640x360&paused`: the first moment, and whether to stay there. `fps`: the frame rate up
// to that moment.
function readMoment(text, fps) {
    const words = new URLSearchParams(text);
    const number = (name, most) => {
        const value = words.has(name) ? Number(words.get(name)) : NaN;
        return Number.isFinite(value) ? Math.max(-most, Math.min(value, most)) : undefined;
    };
    const time = number("time", LAST_FRAME / fps), size = /^(\d+)x(\d+)$/.exec(words.get("size") ?? "");
    const frameAt = value => value === undefined ? undefined : Math.max(0, Math.floor(value));
    const frame = frameAt(number("frame", LAST_FRAME) ?? (time === undefined ? undefined : time * fps));
    return {frame, time: time ?? (frame === undefined ? undefined : frame / fps), paused: words.has("paused"),
            size: size && [Number(size[1]), Number(size[2])]};
}

// Returns iDate for a requested moment: noon of 2024-01-01 plus the time.
const dateAt = time => [2024, 0, 1 + Math.floor((43200 + time) / 86400), (43200 + time) % 86400];

class Figure {
    mouse = new Mouse();
    keyboard = new Keyboard();
    camera = new OrbitCamera();
    clock = new Clock();
    needsFrame = true; // even if time stands still
    isVisible = true;
    remarks = []; // messages for the reader of the page

    constructor(div) {
        this.div = Object.assign(div, {tidemark: this}); // for scripts of the surrounding page
        this.scene = JSON.parse(div.querySelector("script[type='application/json']").textContent);
        this.asked = readMoment(div.dataset.moment ?? location.hash.slice(1), this.scene.numbers.fps);
        this.canvas = element("canvas", {tabIndex: 0, ariaLabel: this.scene.name});
        if (this.scene.size) // only the author's proportions are used; the page decides the size
            this.canvas.style.setProperty("--proportion", this.scene.size[0] / this.scene.size[1]);
        if (this.asked.size)
            Object.assign(this.canvas.style, {aspectRatio: this.asked.size.join("/"), maxHeight: "none"});
        this.message = element("pre", {className: "tidemark-message", textContent: "compiling \u2026"});
        div.append(this.canvas, this.message);
    }

    // Sets `data-state` of the <div>: loading, running or failed.
    async start() {
        this.div.dataset.state = "loading";
        try {
            await this.#prepare();
            await this.#begin();
        } catch (error) {
            this.fail(error instanceof SceneError ? error.message : `${error}`);
        }
    }

    fail(message) {
        this.div.dataset.state = "failed";
        this.message.textContent = message;
        this.message.hidden = false;
    }

    async #prepare() {
        const gl = this.canvas.getContext("webgl2", {alpha: false, antialias: false, depth: false,
                                                     // keeps the picture during a pause
                                                     preserveDrawingBuffer: true});
        if (!gl)
            throw new SceneError("This browser has no WebGL 2: it cannot draw the scene.");
        if (!gl.getExtension("EXT_color_buffer_float"))
            throw new SceneError("This browser's WebGL cannot draw into float textures: it cannot draw the scene.");
        gl.disable(gl.DITHER);
        this.canvas.addEventListener("webglcontextlost",
                                     () => this.fail("The graphics driver was reset. Reload the page."));
        const inputs = await Promise.all(this.scene.inputs.map(input => this.#goOnWithout(
            decodeInput(input), {kind: input.kind === "music" ? "silence" : "none"})));
        const textures = new InputTextures(gl, inputs);
        this.renderer = await Renderer.create(gl, this.scene, textures);
        const sound = await this.#goOnWithout(SoundPass.create(gl, this.scene, textures), null);
        this.player = new Player(sound, inputs.filter(input => input.sound));
        this.videos = textures.all.filter(texture => texture.video);
    }

    // Records an error for the reader and continues with a substitute.
    #goOnWithout(promise, substitute) {
        return promise.catch(error => {
            this.remarks.push(error.message);
            return substitute;
        });
    }

    async #begin() {
        this.bar = new TimeBar({restart: () => this.restart(), togglePause: () => this.togglePause(),
                                seek: time => this.seek(time), toggleSound: () => this.toggleSound(),
                                toggleFullScreen: () => this.toggleFullScreen()}, this.player.hasSound);
        this.panel = knobPanel(this.scene.knobs, () => { this.needsFrame = true; });
        this.div.append(this.bar.element, this.panel);
        listenToPointer(this);
        listenToKeys(this);
        this.#fit();
        new ResizeObserver(() => this.#fit()).observe(this.canvas);
        new IntersectionObserver(([entry]) => { this.isVisible = entry.isIntersecting; }).observe(this.canvas);
        await this.#goTo(this.asked);
        this.message.textContent = this.remarks.join("\n");
        this.message.hidden = this.remarks.length === 0;
        this.div.dataset.state = "running";
        requestAnimationFrame(() => this.#tick());
    }

    now() { return performance.now() / 1000; }

    // Uses as many pixels as the screen has there, unless a size was requested.
    #fit() {
        const {width, height} = this.canvas.getBoundingClientRect(), scale = devicePixelRatio;
        const size = this.asked.size ?? [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
        if (String(size) === String(this.renderer.size))
            return;
        [this.canvas.width, this.canvas.height] = size;
        this.renderer.resize(...size);
        this.needsFrame = true;
    }

    #draw(moment) {
        const {mouse, keyboard, camera, scene: {knobs}} = this;
        this.renderer.draw({...moment, mouse, keyboard, camera, knobs});
        this.bar.show(moment, this.clock.paused, this.player.playing);
        mouse.frameDrawn();
        keyboard.frameDrawn();
        this.needsFrame = false;
    }

    // If frames depend on earlier ones, draws all frames on the way, a few at a time so that the page
    // responds.
    async #goTo({frame, time, paused}) {
        const isAsked = frame !== undefined, last = frame ?? 0, end = time ?? 0, {fps} = this.scene.numbers;
        this.clock.pause(paused, this.now());
        for (let i = this.renderer.hasFeedback ? 0 : last; isAsked && i <= last; ++i) {
            const at = end - (last - i) / fps;
            if (i === last)
                await Promise.all(this.videos.map(video => video.seek(at)));
            this.#draw({frame: i, time: at, delta: 1 / fps, rate: fps, date: dateAt(at)});
            if (i % 8 === 7)
                await new Promise(resolve => setTimeout(resolve));
        }
        this.clock.seek(end, isAsked ? last + 1 : 0, this.now());
        this.needsFrame = !isAsked;
        this.#playOn();
    }

    #tick() {
        if (this.div.dataset.state === "failed")
            return;
        if (!this.isVisible || (this.clock.paused && !this.needsFrame))
            this.clock.rest();
        else {
            const now = this.now(), moment = {...this.clock.nextFrame(now), date: dateOf(new Date())};
            this.#draw(moment);
            this.player.pump({...moment, mouse: this.mouse, camera: this.camera, knobs: this.scene.knobs});
        }
        requestAnimationFrame(() => this.#tick());
    }

    // Starts or stops sound and videos like the clock.
    #playOn() {
        const {paused} = this.clock;
        if (paused)
            this.player.stop();
        else
            this.player.start(this.clock.timeAt(this.now()));
        for (const {video} of this.videos)
            paused ? video.pause() : video.play();
    }

    restart() {
        this.renderer.restart();
        this.seek(0, 0);
    }

    // Jumps to a time; buffers keep their contents.
    seek(time, frame = Math.floor(time * this.scene.numbers.fps)) {
        this.clock.seek(time, frame, this.now());
        this.needsFrame = true;
        this.#playOn();
    }

    togglePause() {
        this.clock.pause(!this.clock.paused, this.now());
        this.needsFrame = true;
        this.#playOn();
    }

    resetCamera() {
        Object.assign(this.camera, new OrbitCamera());
        this.needsFrame = true;
    }

    toggleSound() {
        if (this.player.isOn)
            this.player.turnOff();
        else
            this.player.turnOn();
        this.#playOn();
        this.needsFrame = true;
    }

    toggleFullScreen() {
        if (document.fullscreenElement)
            document.exitFullscreen();
        else
            this.div.requestFullscreen();
    }
}
