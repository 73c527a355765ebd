
// ---- Pictures as a film

// VP8, decoded by the browser if it can (WebCodecs: on pages of this machine, or with https). Calls `tell`
// with true if it can, and with false when it fails: then whole pictures come.
class Film {
    heads = new Map(); // of pictures being decoded, by number

    constructor(onFrame, tell) {
        Object.assign(this, {onFrame, tell});
        Film.#support().then(can => can && tell(true));
    }

    static async #support() {
        return "VideoDecoder" in globalThis && (await VideoDecoder.isConfigSupported({codec: "vp8"})).supported;
    }

    show(head, data) {
        if (head.coding === "key")
            this.#begin();
        if (this.decoder?.state !== "configured")
            return;
        this.heads.set(head.number, head);
        this.decoder.decode(new EncodedVideoChunk({type: head.coding, timestamp: head.number, data}));
    }

    #begin() {
        if (this.decoder && this.decoder.state !== "closed")
            return;
        this.decoder = new VideoDecoder({output: frame => this.#take(frame), error: () => this.tell(false)});
        this.decoder.configure({codec: "vp8", optimizeForLatency: true});
    }

    #take(frame) {
        const head = this.heads.get(frame.timestamp);
        for (const number of this.heads.keys())
            if (number <= frame.timestamp)
                this.heads.delete(number);
        this.onFrame(head, frame);
    }
}
