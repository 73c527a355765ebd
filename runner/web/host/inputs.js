
// ---- Decoding the scene's files, before textures are made

function bytesOf(text) {
    return Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
}

function floatsOf(text) {
    return new Float32Array(bytesOf(text).buffer);
}

// Expands texels to four samples: grey fills red, green and blue, and alpha is 1. A volume's missing green
// and blue are 0.
function fourSamples(samples, channels, isGrey) {
    const from = [[0, -1, -1, -2], [0, 1, -1, -2], [0, 1, 2, -2], [0, 1, 2, 3]][channels - 1];
    const order = isGrey && channels < 3 ? [0, 0, 0, channels === 2 ? 1 : -2] : from;
    const all = new samples.constructor(samples.length / channels * 4), one = samples instanceof Uint8Array ? 255 : 1;
    for (let texel = 0, at = 0; texel < samples.length; texel += channels)
        for (const place of order)
            all[at++] = place >= 0 ? samples[texel + place] : place === -2 ? one : 0;
    return all;
}

// Decodes the samples as stored: no colour space conversion, no alpha multiplication.
function decodePicture(input) {
    return createImageBitmap(new Blob([bytesOf(input.data)], {type: input.type}),
                             {premultiplyAlpha: "none", colorSpaceConversion: "none",
                              imageOrientation: input.flip ? "flipY" : "none"});
}

// Returns the sound and its spectrum, at ShaderToy's sample rate whatever the file has.
async function decodeMusic(input) {
    const context = new OfflineAudioContext(2, 1, SAMPLE_RATE);
    const sound = await context.decodeAudioData(bytesOf(input.data).buffer)
        .catch(() => { throw new SceneError("this browser cannot play the scene's sound file"); });
    return {sound, spectrum: new Spectrum(mixedDown(sound))};
}

// Resolves when the first picture can be shown.
function openVideo(input) {
    const video = Object.assign(document.createElement("video"), {muted: true, loop: true, playsInline: true});
    return new Promise((resolve, reject) => {
        video.onloadeddata = () => resolve(video);
        video.onerror = () => reject(new SceneError("this browser cannot play the scene's video"));
        video.src = URL.createObjectURL(new Blob([bytesOf(input.data)]));
    });
}

// Returns the input with its decoded data.
async function decodeInput(input) {
    switch (input.kind) {
    case "picture": return {...input, bitmap: await decodePicture(input)};
    case "floats": return {...input, samples: fourSamples(floatsOf(input.data), input.channels, true)};
    case "cubemap": return {...input, faces: await Promise.all(input.faces.map(decodeInput))};
    case "volume": {
        const samples = input.floats ? floatsOf(input.data) : bytesOf(input.data);
        return {...input, samples: fourSamples(samples, input.channels, false)};
    }
    case "music": return {...input, ...await decodeMusic(input)};
    case "video": return {...input, video: await openVideo(input)};
    default: return input;
    }
}
