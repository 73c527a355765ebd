
// ---- Mouse and keyboard of the figure

// Effects of a drag, as in the window.
class Drag {
    last = null; // last position

    constructor(figure, turnsCamera) { Object.assign(this, {figure, turnsCamera}); }

    begin(event) {
        const {canvas, mouse} = this.figure;
        canvas.setPointerCapture(event.pointerId);
        canvas.focus({preventScroll: true});
        this.last = placeIn(canvas, event);
        if (event.button === 0)
            mouse.press(...this.last);
        mouse.right ||= event.button === 2;
    }

    move(event) {
        const {canvas, mouse, camera, scene: {followsPointer}} = this.figure, here = placeIn(canvas, event);
        if (followsPointer && !mouse.down)
            mouse.follow(...here);
        if (!this.last)
            return;
        const by = [here[0] - this.last[0], here[1] - this.last[1]];
        mouse.move(...here);
        if (this.turnsCamera && event.buttons & 4)
            camera.pan(...by, canvas.height);
        else if (this.turnsCamera && event.buttons & 1)
            camera.turn(...by, canvas.height);
        this.last = here;
    }

    end(event) {
        const {mouse} = this.figure;
        if (event.button !== 2)
            mouse.release();
        mouse.right &&= event.button !== 2;
        this.last = event.buttons ? this.last : null;
    }
}

function listenToPointer(figure) {
    const {canvas, camera, renderer} = figure, turnsCamera = renderer.uses(...uniformsThatFollow("camera"));
    const drag = new Drag(figure, turnsCamera);
    const on = (name, act, options) => canvas.addEventListener(name, event => {
        act(event);
        figure.needsFrame = true;
    }, options);
    on("pointerdown", event => drag.begin(event));
    canvas.addEventListener("pointermove", event => {
        figure.needsFrame ||= drag.last !== null || figure.scene.followsPointer;
        drag.move(event);
    });
    on("pointerup", event => drag.end(event));
    on("pointercancel", event => drag.end(event));
    if (turnsCamera)
        on("wheel", event => {
            event.preventDefault();
            camera.zoom(-Math.sign(event.deltaY));
        }, {passive: false});
    if (turnsCamera || renderer.uses(...uniformsThatFollow("mouse")))
        canvas.style.touchAction = "none"; // dragging with a finger moves the picture, not the page
    if (renderer.uses("iMouseButton"))
        on("contextmenu", event => event.preventDefault());
}

// The same keys as in the window.
const KEYS = {" ": figure => figure.togglePause(), Home: figure => figure.restart(), f: figure => figure.toggleFullScreen(),
              r: figure => figure.resetCamera()};

// A scene that reads the keyboard gets all keys except those that leave the figure.
function listenToKeys(figure) {
    const {canvas, keyboard, renderer: {readsKeyboard}} = figure;
    canvas.addEventListener("keydown", event => {
        if (event.ctrlKey || event.altKey || event.metaKey || ["Tab", "Escape"].includes(event.key))
            return;
        if (readsKeyboard)
            keyboard.press(event.keyCode);
        else if (event.key in KEYS && !event.repeat)
            KEYS[event.key](figure);
        if (readsKeyboard || event.key in KEYS)
            event.preventDefault();
        figure.needsFrame ||= readsKeyboard;
    });
    canvas.addEventListener("keyup", event => {
        keyboard.release(event.keyCode);
        figure.needsFrame ||= readsKeyboard;
    });
    canvas.addEventListener("blur", () => keyboard.releaseAll());
}
