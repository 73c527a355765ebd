
// ---- Drawing

// Directions at the corners (0,0) (1,0) (1,1) (0,1) of the faces +x -x +y -y +z -z.
const FACE_CORNERS = [
    [1, 1, 1, 1, 1, -1, 1, -1, -1, 1, -1, 1], [-1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1],
    [-1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1], [-1, -1, 1, 1, -1, 1, 1, -1, -1, -1, -1, -1],
    [-1, 1, 1, 1, 1, 1, 1, -1, 1, -1, -1, 1], [1, 1, -1, -1, 1, -1, -1, -1, -1, 1, -1, -1],
];

// Texture unit of `#iKeyboard`, after iChannel0 to iChannel9.
const KEYBOARD_UNIT = 10;
const KEYBOARD_SAMPLER = {magnify: "nearest", minify: "nearest", mipmaps: "none", wrap: "clamp"};

// The textures of the inputs, each made once with mipmaps and once without, if needed.
class InputTextures {
    made = new Map();

    constructor(gl, inputs) { Object.assign(this, {gl, inputs}); }

    of({input, sampler}) {
        const mipmapped = sampler.mipmaps !== "none", key = `${input} ${mipmapped}`;
        if (!this.made.has(key))
            this.made.set(key, new InputTexture(this.gl, this.inputs[input], mipmapped));
        return this.made.get(key);
    }

    get all() { return [...this.made.values()]; }
}

// A pass and the objects needed to draw it.
class DrawnPass {
    // `numbers`: the scene's numbers for the whole run, which uniforms are computed from.
    constructor(gl, pass, program, textures, numbers) {
        Object.assign(this, {gl, program, numbers, index: 0, kind: pass.kind, discards: pass.discards,
                             isForeign: pass.foreign});
        this.uniforms = reflect(gl, program);
        this.channels = pass.channels.map(channel => ({
            ...channel, names: [`iChannel${channel.number}`, `iCh${channel.number}.sampler`],
            texture: channel.input === undefined ? null : textures.of(channel), filter: makeSampler(gl, channel.sampler)}));
        if (this.has("iKeyboard")) {
            const texture = new InputTexture(gl, {kind: "keyboard", rows: 4}, false);
            const filter = makeSampler(gl, KEYBOARD_SAMPLER);
            this.channels.push({number: KEYBOARD_UNIT, names: ["iKeyboard"], texture, filter});
        }
        this.ownTextures = this.channels.map(channel => channel.texture).filter(texture => texture?.isKeyboard);
    }

    has(name) { return this.uniforms.has(name); }

    set(name, numbers, width) {
        if (this.has(name))
            setUniform(this.gl, this.uniforms.get(name), numbers, width);
    }

    // `textureOf` returns the texture that a channel reads in this frame.
    prepare(moment, size, textureOf) {
        const {gl} = this, facts = [];
        gl.useProgram(this.program);
        for (const channel of this.channels) {
            const texture = textureOf(channel);
            if (channel.number !== KEYBOARD_UNIT)
                facts[channel.number] = texture;
            this.#bind(channel, texture);
        }
        const values = uniformsAt({...this.numbers, ...moment}, size, facts, this.isForeign);
        for (const {name, value} of moment.knobs) // a knob may have a name that only other hosts use
            values[name] = [value];
        for (const [name, [numbers, width]] of Object.entries(values))
            this.set(name, numbers, width);
    }

    #bind({number, names, filter}, texture) {
        const {gl} = this;
        gl.activeTexture(gl.TEXTURE0 + number);
        for (const target of [gl.TEXTURE_2D, gl.TEXTURE_CUBE_MAP, gl.TEXTURE_3D])
            gl.bindTexture(target, target === texture.target ? texture.name : null);
        gl.bindSampler(number, filter);
        for (const name of names)
            if (this.has(name))
                gl.uniform1i(this.uniforms.get(name).place, number);
    }
}

// All passes except Sound, in ShaderToy's order: a pass reads the passes before it in their state of this
// frame, itself and those after it in their state of the last frame.
class Renderer {
    static async create(gl, scene, textures) {
        const passes = scene.passes.filter(pass => pass.kind !== "sound");
        const compilations = passes.map(pass => new Compilation(gl, pass));
        const renderer = new Renderer();
        Object.assign(renderer, {gl, textures, passes: []});
        for (const [i, pass] of passes.entries())
            renderer.passes.push(new DrawnPass(gl, pass, await compilations[i].link(), textures, scene.numbers));
        renderer.#makeTargets();
        return renderer;
    }

    // Whether a frame depends on the one before it.
    get hasFeedback() {
        return this.passes.some((pass, i) => pass.discards || pass.channels.some(channel => channel.pass >= i));
    }

    uses(...names) { return this.passes.some(pass => names.some(name => pass.has(name))); }

    get readsKeyboard() {
        return this.passes.some(pass => pass.channels.some(channel => channel.texture?.isKeyboard));
    }

    get image() { return this.passes.findLast(pass => pass.kind === "image"); }

    #makeTargets() {
        this.passes.forEach((pass, i) => {
            const readers = this.passes.flatMap(reader => reader.channels.filter(channel => channel.pass === i));
            const isDouble = pass.channels.some(channel => channel.pass === i) || (pass.discards && pass.kind !== "image");
            const mipmapped = readers.some(channel => channel.sampler.mipmaps !== "none");
            pass.target = new Target(this.gl, pass.kind, {isDouble, mipmapped});
        });
    }

    resize(width, height) {
        this.size = [width, height];
        for (const pass of this.passes)
            pass.target.resize(width, height);
    }

    restart() {
        for (const pass of this.passes)
            pass.target.clear();
    }

    draw(moment) {
        this.#updateInputs(moment);
        for (const pass of this.passes)
            this.#drawPass(pass, moment);
        copyPicture(this.gl, this.image.target.latest.faces[0], null, ...this.size);
    }

    #updateInputs(moment) {
        this.gl.activeTexture(this.gl.TEXTURE0);
        for (const texture of [...this.textures.all, ...this.passes.flatMap(pass => pass.ownTextures)])
            texture.update(moment);
    }

    #textureOf(channel, reader) {
        if (channel.pass === undefined) {
            // A quirk of ShaderToy that shaders may rely on: a cubemap pass sees the keyboard with size 0.
            const hidden = reader.kind === "cubemap" && channel.texture.isKeyboard;
            return hidden ? {...channel.texture, size: [0, 0, 0]} : channel.texture;
        }
        const {target} = this.passes[channel.pass];
        return {name: target.latest.name, target: target.target, size: target.size, time: 0, loaded: true};
    }

    #drawPass(pass, moment) {
        const {gl} = this, {target} = pass;
        pass.prepare(moment, target.size, channel => this.#textureOf(channel, pass));
        gl.viewport(0, 0, target.size[0], target.size[1]);
        target.next.faces.forEach((face, i) => {
            gl.bindFramebuffer(gl.FRAMEBUFFER, face);
            pass.set("tidemark_corners", FACE_CORNERS[i], 3);
            gl.drawArrays(gl.TRIANGLES, 0, 3);
        });
        gl.activeTexture(gl.TEXTURE0);
        target.flip();
    }
}
