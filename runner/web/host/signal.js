
// ---- Music as a texture: 512 bytes of spectrum, then 512 of the wave

const SIGNAL_WIDTH = 512, SAMPLE_RATE = 44100;

// Returns ShaderToy's signal for a silent input.
function silentSignal(time) {
    const turn = 6.2831, bytes = new Uint8Array(2 * SIGNAL_WIDTH);
    for (let i = 0; i < SIGNAL_WIDTH; ++i) {
        const pulse = (0.5 + 0.5 * Math.sin(turn * time)) ** 4, x = i / SIGNAL_WIDTH;
        bytes[i] = 255 * (i < 3 ? pulse * (1 - i / 3) : (0.75 + 0.25 * Math.sin(10 * i + 13 * time)) * Math.exp(-3 * x));
        bytes[SIGNAL_WIDTH + i] =
            255 * (0.5 + 0.15 * Math.sin(17 * time + 10 * turn * x) * Math.sin(23 * time + 1.9 * x));
    }
    return bytes;
}

// Computes the Fourier transform in place; the length must be a power of two.
function transform(real, imaginary) {
    const count = real.length;
    for (let i = 1, j = 0; i < count; ++i) {
        let bit = count >> 1;
        for (; j & bit; bit >>= 1)
            j ^= bit;
        j ^= bit;
        if (i < j)
            [real[i], real[j], imaginary[i], imaginary[j]] = [real[j], real[i], imaginary[j], imaginary[i]];
    }
    for (let length = 2; length <= count; length *= 2)
        for (let k = 0; k < length / 2; ++k) {
            const c = Math.cos(2 * Math.PI * k / length), s = -Math.sin(2 * Math.PI * k / length);
            for (let a = k; a < count; a += length) {
                const b = a + length / 2, re = real[b] * c - imaginary[b] * s, im = real[b] * s + imaginary[b] * c;
                [real[b], imaginary[b]] = [real[a] - re, imaginary[a] - im];
                real[a] += re;
                imaginary[a] += im;
            }
        }
}

// A sound like WebAudio's AnalyserNode shows it, but depending on the time alone. The node smooths from call
// to call; here there are sixty calls a second, of which the last 128 count.
class Spectrum {
    static BLOCK = 2048;
    static REMEMBERED = 128;
    #steps = new Map();

    constructor(mono) {
        this.mono = mono;
        this.duration = mono.length / SAMPLE_RATE;
    }

    at(time) {
        const bytes = new Uint8Array(2 * SIGNAL_WIDTH).fill(128, SIGNAL_WIDTH);
        if (time < 0 || time > this.duration + 3)
            return bytes;
        const smoothed = this.#smoothed(Math.floor(time * 60 + 1e-4));
        const oldest = Math.floor(time * SAMPLE_RATE + 1e-4) - Spectrum.BLOCK;
        for (let i = 0; i < SIGNAL_WIDTH; ++i) {
            const scaled = Math.floor(255 / 70 * (20 * Math.log10(smoothed[i]) + 100));
            bytes[i] = Math.min(255, Math.max(0, scaled));
            bytes[SIGNAL_WIDTH + i] = Math.min(255, Math.max(0, Math.floor(128 * (1 + (this.mono[oldest + i] ?? 0)))));
        }
        return bytes;
    }

    #smoothed(step) {
        const smoothed = new Float32Array(SIGNAL_WIDTH), known = this.#steps;
        this.#steps = new Map();
        for (let past = Math.max(0, step - Spectrum.REMEMBERED + 1); past <= step; ++past) {
            const magnitudes = known.get(past) ?? this.#magnitudes(past);
            this.#steps.set(past, magnitudes);
            for (let k = 0; k < SIGNAL_WIDTH; ++k)
                smoothed[k] = 0.8 * smoothed[k] + 0.2 * magnitudes[k];
        }
        return smoothed;
    }

    // Uses a Blackman window with alpha 0.16.
    #magnitudes(step) {
        const count = Spectrum.BLOCK, first = step * 735 - count;
        const real = new Float64Array(count), imaginary = new Float64Array(count);
        for (let n = 0; n < count; ++n) {
            const turn = 2 * Math.PI * n / count;
            real[n] = (0.42 - 0.5 * Math.cos(turn) + 0.08 * Math.cos(2 * turn)) * (this.mono[first + n] ?? 0);
        }
        transform(real, imaginary);
        return Float32Array.from({length: SIGNAL_WIDTH}, (_, k) => Math.hypot(real[k], imaginary[k]) / count);
    }
}

function mixedDown(buffer) {
    const weights = buffer.numberOfChannels === 6 ? [Math.SQRT1_2, Math.SQRT1_2, 1, 0, 0.5, 0.5]
                                                  : Array(buffer.numberOfChannels).fill(1 / buffer.numberOfChannels);
    const mono = new Float32Array(buffer.length);
    weights.forEach((weight, channel) => buffer.getChannelData(channel).forEach((sample, i) => mono[i] += weight * sample));
    return mono;
}
