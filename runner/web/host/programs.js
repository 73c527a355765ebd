
// ---- Programs

// An error with a message for the reader of the page.
class SceneError extends Error {}

// One triangle that covers the whole target.
const VERTEX_SHADER = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

// A pass that the driver is compiling. `link` returns its program; several can compile at the same time until
// then.
class Compilation {
    constructor(gl, pass) {
        this.gl = gl;
        this.pass = pass;
        this.program = gl.createProgram();
        this.shaders = [[gl.VERTEX_SHADER, VERTEX_SHADER], [gl.FRAGMENT_SHADER, pass.source]].map(([kind, text]) => {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(this.program, shader);
            return shader;
        });
        gl.linkProgram(this.program);
    }

    async link() {
        const {gl, program} = this, parallel = gl.getExtension("KHR_parallel_shader_compile");
        while (parallel && !gl.isContextLost() && !gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR))
            await new Promise(resolve => setTimeout(resolve, 4));
        if (!gl.getProgramParameter(program, gl.LINK_STATUS))
            throw new SceneError(this.#complaint());
        this.shaders.forEach(shader => gl.deleteShader(shader));
        return program;
    }

    // Returns the driver's messages with the author's file names and line numbers.
    #complaint() {
        const log = this.gl.getShaderInfoLog(this.shaders[1]) || this.gl.getProgramInfoLog(this.program) || "";
        const messages = log.replaceAll("\0", "").trim().split("\n").map(line => {
            const [, kind, number, words] = /^(\w+): \d+:(\d+): (.*)$/.exec(line) ?? [];
            return words ? `${placeOf(this.pass, Number(number))}: ${kind.toLowerCase()}: ${words}` : line;
        });
        return `${this.pass.name} does not compile in this browser:\n${messages.join("\n")}`;
    }
}

// Returns the author's place for a line of the text given to the driver.
function placeOf(pass, number) {
    const [first, file, line] = pass.lines.findLast(([start]) => start <= number) ?? [0, "", 0];
    return file ? `${file}:${line + number - first}` : pass.name;
}
