// A VS Code in headless Chromium: its server in a folder of its own, and what a person does in its window.
import { spawn, spawnSync } from "node:child_process";
import { createRequire } from "node:module";
import { mkdirSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { join } from "node:path";

export const k_patience = 120_000; // ms for anything: the machine may be busy
const k_box = ".quick-input-widget:not([style*='display: none']) .quick-input-filter input";

export async function until(what, probe, limit = k_patience) {
    for (const end = Date.now() + limit; ; ) {
        const value = await probe();
        if (value)
            return value;
        if (Date.now() > end)
            throw new Error(`not within ${limit / 1000} s: ${what}`);
        await new Promise((go) => setTimeout(go, 100));
    }
}

const freePort = () => new Promise((done) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
        const { port } = server.address();
        server.close(() => done(port));
    });
});

/** Forwards http://PORT.forwarded.test:OWN to the port of that name, as an editor does with those of a remote machine; returns OWN. */
const startForwarding = () => new Promise((done) => {
    const server = createServer((socket) => socket.once("data", (head) => {
        const to = connect(Number(/^host: (\d+)\.forwarded\.test/im.exec(head)?.[1]), "127.0.0.1");
        for (const end of [to, socket])
            end.on("error", () => [to, socket].forEach((each) => each.destroy()));
        to.write(head);
        socket.pipe(to).pipe(socket);
    })).listen(0, "127.0.0.1", () => done(server.address().port)).unref();
});

/** Starts VS Code's server with an extension installed; `settings` are the user's, `machine` those of the server's machine. */
export async function startServer({ installed, folder, vsix, settings, machine }) {
    const data = join(folder, "data"), main = join(installed, "code/out/server-main.js");
    const set = (name, values) => {
        mkdirSync(join(data, name), { recursive: true });
        writeFileSync(join(data, name, "settings.json"), JSON.stringify(values, null, 2));
    };
    set("User", settings);
    set("Machine", machine);
    const profile = ["--user-data-dir", data, "--extensions-dir", join(folder, "extensions"), "--accept-server-license-terms"];
    const env = { ...process.env, HOME: folder, XDG_CACHE_HOME: join(folder, "cache"), EXTENSIONS_GALLERY: "{}",
                  VSCODE_PROXY_URI: `http://{{port}}.forwarded.test:${await startForwarding()}/` };
    const added = spawnSync(process.execPath, [main, ...profile, "--install-extension", vsix], { env, encoding: "utf8" });
    if (added.status !== 0)
        throw new Error(`the extension was not installed: ${added.stdout}${added.stderr}`);
    const port = await freePort();
    const server = spawn(process.execPath, [main, ...profile, "--host", "127.0.0.1", "--port", String(port), "--without-connection-token",
                                            "--telemetry-level", "off"], { env, stdio: ["ignore", "pipe", "pipe"] });
    let log = "";
    for (const stream of [server.stdout, server.stderr])
        stream.on("data", (text) => log += text);
    const address = `http://127.0.0.1:${port}`;
    await until("VS Code's server", () => {
        if (server.exitCode !== null)
            throw new Error(`VS Code's server ended: ${log.slice(0, 2000)}`);
        return fetch(`${address}/version`).then((answer) => answer.ok, () => false);
    });
    return { address, setMachine: (values) => set("Machine", values), stop: () => new Promise((done) => server.once("exit", done) && server.kill()) };
}

/** Returns an expression's value in a frame; undefined if the frame is unloaded meanwhile. */
export async function valueIn(frame, expression) {
    try {
        return await frame.evaluate(expression);
    } catch {
        return undefined;
    }
}

/** The window of VS Code. */
export class Workbench {
    static async open({ installed, address, workspace, width = 1280, height = 800 }) {
        const puppeteer = createRequire(join(installed, "package.json"))("puppeteer-core");
        const browser = await puppeteer.launch({
            executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
            headless: true,
            args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--host-resolver-rules=MAP *.forwarded.test 127.0.0.1, MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"],
            defaultViewport: { width, height },
            protocolTimeout: 2 * k_patience,
        });
        const page = await browser.newPage();
        page.setDefaultTimeout(k_patience);
        const window = new Workbench(browser, page);
        page.on("console", (message) => window.console.push(message.text().slice(0, 400)));
        await page.goto(`${address}/?folder=${workspace}`, { waitUntil: "domcontentloaded" });
        await page.waitForSelector(".explorer-folders-view .monaco-list-row");
        return window;
    }

    console = [];

    constructor(browser, page) {
        this.browser = browser;
        this.page = page;
    }

    close() { return this.browser.close(); }

    async press(...keys) {
        for (const key of keys.slice(0, -1))
            await this.page.keyboard.down(key);
        await this.page.keyboard.press(keys.at(-1));
        for (const key of keys.slice(0, -1).reverse())
            await this.page.keyboard.up(key);
    }

    /** Presses keys until the box at the top opens: a window that has just opened may not hear the first. */
    async #openBox(...keys) {
        await until(`the box that ${keys.join("+")} opens`, async () => {
            await this.press(...keys);
            return this.page.waitForSelector(k_box, { timeout: 5000 }).catch(() => false);
        });
    }

    /** Types into the box at the top, and chooses the row that has the wanted words. */
    async #choose(text, wanted) {
        await this.press("Control", "a");
        await this.page.keyboard.type(text, { delay: 10 });
        await this.page.waitForFunction((wanted) => {
            const rows = ".quick-input-list .monaco-list-row";
            const row = document.querySelector(`${rows}.focused`) ?? document.querySelector(rows);
            return row?.getAttribute("aria-label")?.includes(wanted);
        }, {}, wanted);
        await this.page.keyboard.press("Enter");
    }

    async openFile(name) {
        await this.toEditor();
        await this.#openBox("Control", "p");
        await this.#choose(name, name);
        await this.page.waitForFunction((name) => document.querySelector(".part.editor .tab.active")?.textContent.includes(name), {}, name);
        await this.page.waitForSelector(".editor-instance .view-lines .view-line");
    }

    async command(title) {
        await this.toEditor();
        await this.#openBox("F1");
        await this.#choose(`>Tidemark: ${title}`, `Tidemark: ${title}`);
    }

    /** Brings the focus from a webview back to the first editor. */
    async toEditor() {
        const lines = await this.page.$(".editor-instance .view-lines");
        await lines?.click({ offset: { x: 40, y: 5 } }).catch(() => {});
    }

    async closeBox() {
        await this.page.waitForSelector(k_box);
        await this.press("Escape");
        await this.page.waitForSelector(k_box, { hidden: true });
    }

    /** Gives the window another size, and hides all but the editors; returns a function that undoes it. */
    async tidy(width, height) {
        const { width: oldWidth, height: oldHeight } = this.page.viewport();
        const toggle = async () => {
            await this.toEditor();
            await this.press("Control", "b");
            await this.press("Control", "j");
        };
        await toggle();
        await this.page.setViewport({ width, height });
        await this.clearNotifications();
        await new Promise((go) => setTimeout(go, 3000)); // for the layout
        return async () => {
            await this.page.setViewport({ width: oldWidth, height: oldHeight });
            await toggle();
            await this.page.waitForSelector(".markers-panel");
        };
    }

    /** Whether the box at the top shows a path and has read its folder. */
    #seesFolder() {
        return this.page.evaluate((box) => {
            const path = document.querySelector(box)?.value;
            return path?.includes("/") && !document.querySelector(".quick-input-widget .monaco-progress-container.active") ? path : undefined;
        }, k_box);
    }

    /**
     * Answers a file dialog. It reads a folder at each change of its text, and changes the text then: so the path comes as one change,
     * and Enter when the dialog rests with it. Before that, Enter would choose the folder above.
     */
    async answerFile(path) {
        await until("the file dialog", () => this.#seesFolder());
        await until("the file dialog closes", async () => {
            if (!await this.page.$(k_box))
                return true;
            const shown = await this.#seesFolder();
            if (shown === undefined)
                return false;
            await this.page.focus(k_box);
            if (shown !== path) {
                await this.press("Control", "a");
                await this.page.keyboard.sendCharacter(path);
                return false;
            }
            await this.page.keyboard.press("Enter");
            return this.page.waitForSelector(k_box, { hidden: true, timeout: 10_000 }).then(() => true, () => false);
        });
    }

    async goTo(line, column) {
        await this.toEditor();
        await this.#openBox("Control", "g");
        await this.page.keyboard.type(`${line}:${column}`, { delay: 10 });
        await this.page.keyboard.press("Enter");
        await this.page.waitForFunction((place) => document.querySelector("#status\\.editor\\.selection")?.textContent.includes(place), {},
                                        `Ln ${line}, Col ${column}`);
    }

    /** Types over so many characters after a place. */
    async typeOver(line, column, count, text) {
        await this.goTo(line, column);
        await this.page.keyboard.down("Shift");
        for (let i = 0; i < count; ++i)
            await this.page.keyboard.press("ArrowRight");
        await this.page.keyboard.up("Shift");
        await this.page.keyboard.type(text, { delay: 30 });
        await this.press("Escape"); // closes a list of completions
    }

    async save() {
        await this.toEditor();
        await this.press("Control", "s");
        await this.page.waitForFunction(() => !document.querySelector(".part.editor .tab.active.dirty"));
    }

    async showProblems() {
        if (!await this.page.$(".markers-panel"))
            await this.press("Control", "Shift", "m");
        await this.page.waitForSelector(".markers-panel");
    }

    problems() {
        return this.page.$$eval(".markers-panel .monaco-list-row", (rows) => rows.map((row) => row.textContent));
    }

    async problem(...words) {
        let rows = [];
        return until(`a problem with ${words.join(" and ")}`, async () => {
            rows = await this.problems();
            return rows.find((row) => words.every((word) => row.includes(word)));
        }).catch((error) => {
            throw new Error(`${error.message}; there are ${JSON.stringify(rows)}`);
        });
    }

    /** Waits for a notification with these words, and returns its text. */
    async notification(...words) {
        const seen = new Set();
        return until(`a notification with ${words.join(" and ")}`, async () => {
            const texts = await this.page.$$eval(".notifications-toasts .notification-list-item-message", (all) => all.map((each) => each.textContent));
            texts.forEach((text) => seen.add(text));
            return texts.find((text) => words.every((word) => text.includes(word)));
        }).catch((error) => {
            throw new Error(`${error.message}; there were ${JSON.stringify([...seen])}`);
        });
    }

    async clearNotifications() {
        await this.page.evaluate(() =>
            document.querySelectorAll(".notifications-toasts .codicon-notifications-clear").forEach((button) => button.click()));
    }

    /** Returns the frame, of webviews and pages in them, in which an expression is true. */
    frame(what, expression) {
        return until(`a frame with ${what}`, async () => {
            for (const frame of this.page.frames())
                if (await valueIn(frame, expression))
                    return frame;
            return undefined;
        });
    }

    /** Returns pixels of a PNG file's bytes, as RGBA bytes, top row first. */
    async pixelsOf(png) {
        const values = await this.page.evaluate(async (text) => {
            const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
            const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }), { colorSpaceConversion: "none" });
            const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
            context.drawImage(bitmap, 0, 0);
            return [...context.getImageData(0, 0, bitmap.width, bitmap.height).data];
        }, png.toString("base64"));
        return values;
    }

    screenshot(path, clip) { return this.page.screenshot({ path, clip }); }
}
