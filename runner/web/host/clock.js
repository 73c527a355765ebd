
// ---- iTime, iTimeDelta, iFrame, iFrameRate

// ShaderToy's rules: a pause freezes iTime, but frames drawn meanwhile count; the first frame after a start,
// a pause or a jump has an iTimeDelta of 1/60; iFrameRate is a mean over half a second and starts at 60.
class Clock {
    paused = false;
    frame = 0; // the next one
    rate = 60;
    #time = 0; // at #since, or while paused
    #since = 0;
    #drawn = 0;
    #isFresh = true;
    #windowStart = 0;
    #windowFrames = 0;

    timeAt(now) { return this.paused ? this.#time : this.#time + (now - this.#since); }

    pause(paused, now) {
        this.seek(this.timeAt(now), this.frame, now);
        this.paused = paused;
    }

    seek(time, frame, now) {
        [this.#time, this.frame, this.#since, this.#isFresh] = [time, frame, now, true];
    }

    // Marks a break in drawing, so that the next iTimeDelta is 1/60.
    rest() { this.#isFresh = true; }

    nextFrame(now) {
        this.#measure(now);
        const moment = {frame: this.frame++, time: this.timeAt(now), rate: this.rate,
                        delta: this.#isFresh || this.paused ? 1 / 60 : now - this.#drawn};
        this.#drawn = now;
        this.#isFresh = false;
        return moment;
    }

    #measure(now) {
        const past = now - this.#windowStart;
        if (!this.#isFresh && past >= 0.5)
            this.rate = (this.#windowFrames + 1) / past;
        if (this.#isFresh || past >= 0.5)
            [this.#windowStart, this.#windowFrames] = [now, 0];
        else
            ++this.#windowFrames;
    }
}

// Returns iDate for a Date, in local time.
function dateOf(now) {
    const seconds = (now.getHours() * 60 + now.getMinutes()) * 60 + now.getSeconds() + now.getMilliseconds() / 1000;
    return [now.getFullYear(), now.getMonth(), now.getDate(), seconds];
}
