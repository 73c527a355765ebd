
// ---- The keyboard's texture

// Rows of 256 texels, one per JavaScript key code: down, pressed since the last frame, toggled, released
// since the last frame.
class Keyboard {
    texels = new Uint8Array(4 * 256);

    press(code) {
        if (!(code in this.texels.subarray(0, 256)) || this.texels[code])
            return;
        this.texels[code] = this.texels[256 + code] = 255;
        this.texels[512 + code] = 255 - this.texels[512 + code];
    }

    release(code) {
        if (!this.texels.subarray(0, 256)[code])
            return;
        this.texels[code] = this.texels[256 + code] = 0;
        this.texels[768 + code] = 255;
    }

    releaseAll() {
        for (let code = 0; code < 256; ++code)
            this.release(code);
    }

    frameDrawn() {
        this.texels.fill(0, 256, 512);
        this.texels.fill(0, 768, 1024);
    }
}
