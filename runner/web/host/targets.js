
// ---- Render targets

const CUBE_SIDE = 1024;

// One texture; or two that alternate, if the pass reads itself or keeps pixels of earlier frames. Initially
// zero.
class Target {
    constructor(gl, kind, {isDouble, mipmapped}) {
        this.gl = gl;
        this.isCube = kind === "cubemap";
        this.format = {image: gl.RGBA8, cubemap: gl.RGBA16F}[kind] ?? floatFormat(gl);
        this.target = this.isCube ? gl.TEXTURE_CUBE_MAP : gl.TEXTURE_2D;
        this.count = isDouble ? 2 : 1;
        this.mipmapped = mipmapped;
        this.surfaces = [];
        this.latestIndex = 0;
    }

    get latest() { return this.surfaces[this.latestIndex]; }
    get next() { return this.surfaces[this.count - 1 - this.latestIndex]; }

    // Keeps the old contents as far as they fit.
    resize(width, height) {
        const size = this.isCube ? [CUBE_SIDE, CUBE_SIDE, 1] : [width, height, 1];
        if (String(size) === String(this.size))
            return;
        const old = this.surfaces, latest = this.latest;
        [this.size, this.latestIndex] = [size, 0];
        this.surfaces = Array.from({length: this.count}, () => this.#makeSurface());
        if (latest)
            copyPicture(this.gl, latest.faces[0], this.latest.faces[0], width, height);
        for (const surface of old)
            this.#drop(surface);
        this.#makeMipmaps();
    }

    flip() {
        this.latestIndex = this.count - 1 - this.latestIndex;
        this.#makeMipmaps();
    }

    clear() {
        for (const {faces} of this.surfaces)
            for (const face of faces) {
                this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, face);
                this.gl.clearBufferfv(this.gl.COLOR, 0, [0, 0, 0, 0]);
            }
        this.#makeMipmaps();
    }

    #makeSurface() {
        const {gl, target} = this, name = gl.createTexture(), [width, height] = this.size;
        gl.bindTexture(target, name);
        gl.texStorage2D(target, this.mipmapped ? levelsOf(width, height) : 1, this.format, width, height);
        const faces = Array.from({length: this.isCube ? 6 : 1}, (_, face) => {
            const frame = gl.createFramebuffer();
            gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
            gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0,
                                    this.isCube ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : target, name, 0);
            gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
            return frame;
        });
        return {name, faces};
    }

    #makeMipmaps() {
        if (!this.mipmapped)
            return;
        this.gl.bindTexture(this.target, this.latest.name);
        this.gl.generateMipmap(this.target);
    }

    #drop({name, faces}) {
        this.gl.deleteTexture(name);
        faces.forEach(face => this.gl.deleteFramebuffer(face));
    }
}

// Copies one frame buffer to another; null is the canvas.
function copyPicture(gl, from, to, width, height) {
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
}
