
// ---- iMouse

// iMouse during press, drag and release. Pixels from the bottom left. xy changes only while the button is
// down, or follows the pointer for texts of other hosts; zw is the press position: z is positive while the button is down, w only in the first frame after the
// press.
class Mouse {
    position = [0, 0];
    pressedAt = [0, 0];
    down = false;
    right = false; // the other button
    isNew = false; // no frame has been drawn since the press

    press(x, y) {
        this.down = this.isNew = true;
        this.move(x, y);
        this.pressedAt = this.position;
    }

    move(x, y) {
        if (this.down)
            this.follow(x, y);
    }

    follow(x, y) { this.position = [Math.floor(x) + 0, Math.floor(y) + 0]; } // -0 + 0 is 0

    release() { this.down = false; }

    frameDrawn() { this.isNew = false; }

    get uniform() {
        const [x, y] = this.pressedAt;
        return [...this.position, this.down ? x : 0 - x, this.isNew ? y : 0 - y];
    }
}
