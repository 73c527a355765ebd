
// ---- Sound

const SOUND_TILE = 512;                                        // texels per side, one sample each
const SOUND_BLOCK = SOUND_TILE * SOUND_TILE, SOUND_ROWS = 64; // rows drawn at a time

// Draws the Sound pass: 16-bit samples as low and high byte, left and right.
class SoundPass {
    static async create(gl, scene, textures) {
        const pass = scene.passes.find(pass => pass.kind === "sound");
        if (!pass)
            return null;
        const program = await new Compilation(gl, pass).link();
        const drawn = new DrawnPass(gl, pass, program, textures, scene.numbers);
        const sound = Object.assign(new SoundPass(), {gl, pass: drawn});
        sound.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, sound.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, SOUND_TILE, SOUND_TILE);
        sound.frame = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, sound.frame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, sound.texture, 0);
        return sound;
    }

    // Draws SOUND_ROWS rows from the sample `first` on, which must begin a row. Returns numbers from -32767
    // to 32767, left and right alternating.
    draw(first, moment) {
        const {gl} = this, block = first - first % SOUND_BLOCK, row = (first - block) / SOUND_TILE;
        this.pass.prepare(moment, [SOUND_TILE, SOUND_TILE], channel => channel.texture);
        this.pass.set("iTimeOffset", [block / SAMPLE_RATE]);
        this.pass.set("iSampleOffset", [block]);
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
        gl.viewport(0, 0, SOUND_TILE, SOUND_TILE);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(0, row, SOUND_TILE, SOUND_ROWS);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.disable(gl.SCISSOR_TEST);
        const texels = new Uint8Array(SOUND_TILE * SOUND_ROWS * 4);
        gl.readPixels(0, row, SOUND_TILE, SOUND_ROWS, gl.RGBA, gl.UNSIGNED_BYTE, texels);
        return Int16Array.from({length: texels.length / 2}, (_, i) =>
            Math.round(32767 * (-1 + 2 * (texels[2 * i] + 256 * texels[2 * i + 1]) / 65535)));
    }
}

// Plays the Sound pass and the music that the scene reads, from any time on.
class Player {
    #context = null; // browsers allow sound only after a user's action
    #sources = new Set();
    #origin = 0; // the context's time at which the scene's time is 0
    #next = 0;   // next sample of the Sound pass to draw

    constructor(pass, music) {
        this.pass = pass;
        this.music = music;
    }

    get hasSound() { return this.pass !== null || this.music.length > 0; }
    get isOn() { return this.#context !== null; }

    turnOn() { this.#context = new AudioContext({sampleRate: SAMPLE_RATE}); }

    turnOff() {
        this.stop();
        this.#context?.close();
        this.#context = null;
    }

    stop() {
        for (const source of this.#sources)
            source.stop();
        this.#sources.clear();
        this.playing = false;
    }

    // Plays from that time of the scene on.
    start(time) {
        this.stop();
        if (!this.isOn)
            return;
        this.playing = true;
        this.#origin = this.#context.currentTime - time;
        this.#next = Math.floor(time * SAMPLE_RATE / SOUND_TILE) * SOUND_TILE;
        for (const {sound} of this.music)
            this.#play(sound, this.#context.currentTime, time % sound.duration, true);
    }

    // Keeps two seconds of the Sound pass ready, a few rows per frame.
    pump(moment) {
        if (!this.playing || !this.pass || this.#origin + this.#next / SAMPLE_RATE > this.#context.currentTime + 2)
            return;
        const rows = Math.min(SOUND_ROWS, (SOUND_BLOCK - this.#next % SOUND_BLOCK) / SOUND_TILE);
        const samples = this.pass.draw(this.#next, moment), count = rows * SOUND_TILE;
        const buffer = this.#context.createBuffer(2, count, SAMPLE_RATE);
        for (const side of [0, 1])
            buffer.copyToChannel(Float32Array.from({length: count}, (_, i) => samples[2 * i + side] / 32768), side);
        const start = this.#origin + this.#next / SAMPLE_RATE, late = Math.max(0, this.#context.currentTime - start);
        this.#next += count;
        if (late < buffer.duration)
            this.#play(buffer, start + late, late, false);
    }

    #play(buffer, at, offset, loop) {
        const source = new AudioBufferSourceNode(this.#context, {buffer, loop});
        source.onended = () => this.#sources.delete(source);
        source.connect(this.#context.destination);
        source.start(at, offset);
        this.#sources.add(source);
    }
}
