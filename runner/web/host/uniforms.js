
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

// Returns the values of iChannelTime and iChannelResolution. `channels` has textures by number, with gaps.
const channelTimes = channels => Array.from({length: 10}, (_, i) => channels[i]?.time ?? 0);
const channelSizes = channels => Array.from({length: 10}, (_, i) => channels[i]?.size ?? [0, 0, 0]).flat();

// The host's uniforms: their names, other hosts' names for them, what changes them (clock, mouse, camera), how many
// numbers make an element of an array, and their numbers. `export` writes the rows, from scene/host_uniforms.hpp.
const HOST_UNIFORMS = [
    // {{uniforms}}
];

// Returns the uniforms' values: numbers, and how many make an element. `isForeign`: by other hosts' names too, which
// ShaderToy's own shaders do not get: one declared there stays zero.
function uniformsAt(moment, size, channels, isForeign) {
    const values = {};
    for (const {names, others, width, value} of HOST_UNIFORMS)
        for (const name of isForeign ? [...names, ...others] : names)
            values[name] = [value(moment, size, channels), width];
    channels.forEach((texture, i) => {
        values[`iCh${i}.size`] = values[`iChannel[${i}].resolution`] = [texture.size];
        values[`iCh${i}.time`] = values[`iChannel[${i}].time`] = [[texture.time ?? 0]];
        values[`iCh${i}.loaded`] = [[Number(texture.loaded)]];
    });
    return values;
}

// Returns the names of the uniforms that the mouse or the camera changes.
function uniformsThatFollow(what) {
    return HOST_UNIFORMS.filter(({follows}) => follows === what).flatMap(({names, others}) => [...names, ...others]);
}
