
// ---- Textures of the channels

function levelsOf(...sides) {
    return Math.floor(Math.log2(Math.max(...sides))) + 1;
}

// Half floats on phones that cannot filter floats.
function floatFormat(gl) {
    return gl.getExtension("OES_texture_float_linear") ? gl.RGBA32F : gl.RGBA16F;
}

// A texture and the values of its channel uniforms: `size`, `time` (iChannelTime) and `loaded`.
// `update(moment)` brings it up to that moment.
class InputTexture {
    loaded = true;
    time = 0;

    constructor(gl, input, mipmapped) {
        this.gl = gl;
        this.name = gl.createTexture();
        this.target = gl.TEXTURE_2D;
        this.mipmapped = mipmapped;
        this[`make_${input.kind}`](input);
    }

    update() {}

    #store(size, format) {
        const {gl, target} = this;
        gl.bindTexture(target, this.name);
        const levels = this.mipmapped ? levelsOf(...size) : 1;
        if (target === gl.TEXTURE_3D)
            gl.texStorage3D(target, levels, format, ...size);
        else
            gl.texStorage2D(target, levels, format, size[0], size[1]);
        this.size = size;
    }

    #finish() {
        if (this.mipmapped)
            this.gl.generateMipmap(this.target);
    }

    #formatOf(input) {
        return input.kind === "floats" ? floatFormat(this.gl) : input.red ? this.gl.R8 : this.gl.RGBA8;
    }

    #put(place, input) {
        const {gl} = this;
        if (input.kind === "floats")
            gl.texSubImage2D(place, 0, 0, 0, input.width, input.height, gl.RGBA, gl.FLOAT, input.samples);
        else
            gl.texSubImage2D(place, 0, 0, 0, input.red ? gl.RED : gl.RGBA, gl.UNSIGNED_BYTE, input.bitmap);
    }

    make_picture(input) {
        this.#store([input.bitmap.width, input.bitmap.height, 1], this.#formatOf(input));
        this.#put(this.target, input);
        this.#finish();
    }

    make_floats(input) {
        this.#store([input.width, input.height, 1], this.#formatOf(input));
        this.#put(this.target, input);
        this.#finish();
    }

    make_cubemap(input) {
        this.target = this.gl.TEXTURE_CUBE_MAP;
        this.#store([input.side, input.side, 1], this.#formatOf(input.faces[0]));
        input.faces.forEach((face, i) => this.#put(this.gl.TEXTURE_CUBE_MAP_POSITIVE_X + i, face));
        this.#finish();
        this.size = [0, 0, 0]; // ShaderToy reports no size for a cubemap from files
    }

    make_volume(input) {
        const {gl} = this;
        this.target = gl.TEXTURE_3D;
        this.#store(input.size, input.floats ? floatFormat(gl) : gl.RGBA8);
        gl.texSubImage3D(this.target, 0, 0, 0, 0, ...input.size, gl.RGBA, input.floats ? gl.FLOAT : gl.UNSIGNED_BYTE,
                         input.samples);
        this.#finish();
    }

    #makeBytes(width, height, bytesAt) {
        const {gl} = this;
        this.mipmapped = false;
        this.#store([width, height, 1], gl.R8);
        this.update = moment => {
            gl.bindTexture(this.target, this.name);
            gl.texSubImage2D(this.target, 0, 0, 0, width, height, gl.RED, gl.UNSIGNED_BYTE, bytesAt(moment));
        };
    }

    make_keyboard(input) {
        this.isKeyboard = true;
        this.#makeBytes(256, input.rows, moment => moment.keyboard.texels.subarray(0, 256 * input.rows));
    }

    make_silence() {
        this.#makeBytes(SIGNAL_WIDTH, 2, moment => {
            this.time = 10 + moment.time;
            return silentSignal(moment.time);
        });
    }

    make_music({spectrum}) {
        this.#makeBytes(SIGNAL_WIDTH, 2, moment => {
            this.time = moment.time % spectrum.duration;
            return spectrum.at(this.time);
        });
    }

    make_video({video, flip}) {
        const {gl} = this;
        this.video = video;
        this.#store([video.videoWidth, video.videoHeight, 1], gl.RGBA8);
        this.update = moment => {
            this.time = moment.time % video.duration;
            if (Math.abs(video.currentTime - this.time) > 0.25)
                video.currentTime = this.time;
            gl.bindTexture(this.target, this.name);
            gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, flip);
            gl.texSubImage2D(this.target, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, video);
            gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
            this.#finish();
        };
    }

    // Without a texture, WebGL reads opaque black.
    make_none() {
        this.gl.deleteTexture(this.name);
        this.name = null;
        this.loaded = false;
        this.size = [0, 0, 0];
    }

    // Shows a time in a video; other inputs need no seeking.
    async seek(time) {
        const {video} = this;
        if (!video)
            return;
        // The picture may come after `seeked`; it does not come if it is already shown, hence the time limit.
        const come = new Promise(resolve => {
            video.requestVideoFrameCallback?.(resolve);
            setTimeout(resolve, 1000);
        });
        await new Promise(resolve => {
            video.onseeked = resolve;
            video.currentTime = time % video.duration;
        });
        await come;
    }
}

function makeSampler(gl, {magnify, minify, mipmaps, wrap}) {
    const sampler = gl.createSampler();
    const filter = minify.toUpperCase() + (mipmaps === "none" ? "" : `_MIPMAP_${mipmaps.toUpperCase()}`);
    gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, gl[magnify.toUpperCase()]);
    gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, gl[filter]);
    for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
        gl.samplerParameteri(sampler, axis, {repeat: gl.REPEAT, clamp: gl.CLAMP_TO_EDGE, mirror: gl.MIRRORED_REPEAT}[wrap]);
    return sampler;
}
