
// ---- Uniforms

// Returns how many numbers a uniform of that type takes, and the suffix of WebGL's function for it.
function shapeOf(gl, type) {
    const shapes = {
        [gl.FLOAT]: [1, "1fv"], [gl.FLOAT_VEC2]: [2, "2fv"], [gl.FLOAT_VEC3]: [3, "3fv"], [gl.FLOAT_VEC4]: [4, "4fv"],
        [gl.INT]: [1, "1iv"], [gl.INT_VEC2]: [2, "2iv"], [gl.INT_VEC3]: [3, "3iv"], [gl.INT_VEC4]: [4, "4iv"],
        [gl.BOOL]: [1, "1iv"], [gl.BOOL_VEC2]: [2, "2iv"], [gl.BOOL_VEC3]: [3, "3iv"], [gl.BOOL_VEC4]: [4, "4iv"],
        [gl.UNSIGNED_INT]: [1, "1uiv"], [gl.UNSIGNED_INT_VEC2]: [2, "2uiv"], [gl.UNSIGNED_INT_VEC3]: [3, "3uiv"],
        [gl.UNSIGNED_INT_VEC4]: [4, "4uiv"],
    };
    return shapes[type];
}

// Returns a program's active uniforms by name, arrays without `[0]`.
function reflect(gl, program) {
    const uniforms = new Map();
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
        const {name, type, size} = gl.getActiveUniform(program, i);
        uniforms.set(name.replace(/\[0\]$/, ""), {type, size, place: gl.getUniformLocation(program, name)});
    }
    return uniforms;
}

// Sets a uniform of whatever type the author declared. `width` is how many of the numbers belong to one
// element of an array.
function setUniform(gl, {type, size, place}, numbers, width = numbers.length) {
    if (type === gl.FLOAT_MAT4) {
        gl.uniformMatrix4fv(place, false, numbers);
        return;
    }
    const [count, call] = shapeOf(gl, type) ?? [0];
    if (!count)
        return;
    const values = Array.from({length: count * size}, (_, i) =>
        i % count < width ? numbers[Math.floor(i / count) * width + i % count] ?? 0 : 0);
    gl[`uniform${call}`](place, values);
}

// Returns the uniforms' values: numbers, and how many make an element. `channels` has textures by number,
// with gaps.
function uniformsAt(moment, size, channels) {
    const [width, height] = size, mouse = moment.mouse.uniform;
    const {orbit, pan} = moment.camera.motion;
    const all = read => Array.from({length: 10}, (_, i) => channels[i] && read(channels[i]));
    const values = {
        iResolution: [[width, height, 1]],
        iTime: [[moment.time]], iTimeLow: [[moment.time - Math.fround(moment.time)]],
        iTimeDelta: [[moment.delta]], iFrame: [[moment.frame]], iFrameRate: [[moment.rate]],
        iMouse: [mouse],
        iMouseButton: [[Number(moment.mouse.down), Number(moment.mouse.right), 0, 0]],
        iDate: [moment.date], iSampleRate: [[SAMPLE_RATE]],
        iChannelTime: [all(texture => texture.time).map(time => time ?? 0), 1],
        iChannelResolution: [all(texture => texture.size).flatMap(of => of ?? [0, 0, 0]), 3],
        iCamera: [moment.camera.matrix], iViewMatrix: [moment.camera.seenFrom(new OrbitCamera())],
        iOrbit: [[...orbit, 1]], iOrbitPan: [pan],
    };
    channels.forEach((texture, i) => {
        values[`iCh${i}.size`] = values[`iChannel[${i}].resolution`] = [texture.size];
        values[`iCh${i}.time`] = values[`iChannel[${i}].time`] = [[texture.time ?? 0]];
        values[`iCh${i}.loaded`] = [[Number(texture.loaded)]];
    });
    return values;
}

// Returns the uniforms of the VS Code extension, glslsandbox.com and glslViewer. ShaderToy's own shaders do
// not get them: one declared there stays zero.
function uniformsOfOthersAt(moment, [width, height]) {
    const mouse = moment.mouse.uniform;
    return {
        resolution: [[width, height, 1]], time: [[moment.time]], mouse: [[mouse[0] / width, mouse[1] / height]],
        u_resolution: [[width, height]], u_mouse: [[mouse[0], mouse[1]]], u_time: [[moment.time]],
        u_delta: [[moment.delta]], u_frame: [[moment.frame]], u_date: [moment.date],
    };
}
