// The preview beside the editor: a webview that frames the page of `tidemark serve`, which the language server starts.
import { randomBytes } from "node:crypto";
import * as fs from "node:fs";
import * as path from "node:path";
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { Failure, run, showFailure } from "./program";
import { Scene } from "./scene";
import { splitWords } from "./words";

export const k_view = "tidemark.preview";
const k_answer_ms = 5000;

/** Numbers of the picture on show, from the page. */
interface Shown {
    /** Milliseconds that drawing took. */
    draw: number;
    seconds: number;
    frame: number;
    size: [number, number];
    /** How many of its pixels are not finite, in the frame that was last tested. */
    bad: number;
}

/** What the language server has measured of a scene; without numbers: nothing of its present texts. */
export interface Measured {
    scene: string;
    /** Root mean square and largest difference of colours in float from those in double; 1 is white. */
    rmse?: number;
    worst?: number;
    /** Why there are no numbers. */
    why?: string;
}

/** A pixel of the picture, counted from the bottom left. */
export interface Pixel {
    x: number;
    y: number;
}

/** A message of the webview or of the page in it; the page is not trusted. */
interface Message {
    tidemark?: string;
    [name: string]: unknown;
}

export class Preview implements vscode.Disposable {
    private readonly subscriptions: vscode.Disposable[] = [];
    private readonly waiting = new Map<string, (message: Message | undefined) => void>();
    private loading = "";
    shown: Shown | undefined;

    constructor(
        readonly scene: Scene,
        readonly panel: vscode.WebviewPanel,
        private readonly client: () => LanguageClient | undefined,
        private readonly events: { shown(preview: Preview): void; trace(preview: Preview, pixel: Pixel): void },
    ) {
        panel.webview.onDidReceiveMessage((message: Message) => this.receive(message), undefined, this.subscriptions);
        panel.onDidDispose(() => this.dispose(), undefined, this.subscriptions);
        this.load();
    }

    dispose(): void {
        this.subscriptions.splice(0).forEach((each) => each.dispose());
        this.waiting.forEach((answer) => answer(undefined));
        this.waiting.clear();
        this.client()?.sendRequest("workspace/executeCommand", { command: "tidemark.closePreview", arguments: [this.scene.document.toString()] })
            .catch(() => undefined); // the server may have ended
    }

    /** Loads the page: first a document that names its origins, then the page in a frame that these origins may hold. */
    load(): void {
        this.shown = undefined;
        this.loading = randomBytes(8).toString("hex"); // another text, so that the webview loads it anew
        const nonce = makeNonce();
        this.panel.webview.html = document(
            `default-src 'none'; script-src 'nonce-${nonce}'; style-src 'nonce-${nonce}'`,
            nonce,
            `<p>Starting the preview…</p>
<script nonce="${nonce}">
acquireVsCodeApi().postMessage({tidemark: "origins", loading: "${this.loading}",
                                origins: [location.origin, ...location.ancestorOrigins ?? []]});
</script>`,
        );
    }

    /** Returns the command that captures the moment on show, as words without the program; undefined if the page does not answer. */
    async moment(): Promise<string[] | undefined> {
        const answer = await this.ask("command");
        return typeof answer?.text === "string" ? splitWords(answer.text).slice(1) : undefined;
    }

    /** Waits until the user clicks a pixel in the picture; undefined after Esc. */
    async pick(cancel: vscode.CancellationToken): Promise<Pixel | undefined> {
        this.panel.reveal(undefined, false);
        const subscription = cancel.onCancellationRequested(() => {
            this.post({ tidemark: "cancel" });
            this.answer("pick", undefined);
        });
        const answer = await this.ask("pick", Infinity);
        subscription.dispose();
        return asPixel(answer);
    }

    private ask(what: string, limit = k_answer_ms): Promise<Message | undefined> {
        this.answer(what, undefined);
        return new Promise((resolve) => {
            const timer = limit === Infinity ? undefined : setTimeout(() => this.answer(what, undefined), limit);
            this.waiting.set(what, (message) => {
                clearTimeout(timer);
                resolve(message);
            });
            this.post({ tidemark: what });
        });
    }

    private answer(what: string, message: Message | undefined): void {
        const resolve = this.waiting.get(what);
        this.waiting.delete(what);
        resolve?.(message);
    }

    private post(message: Message): void {
        this.panel.webview.postMessage(message);
    }

    private receive(message: Message): void {
        const pixel = asPixel(message);
        switch (message?.tidemark) {
            case "origins":
                if (message.loading === this.loading && Array.isArray(message.origins)) {
                    this.loading += "+"; // a webview may load its document twice
                    this.frame(message.origins.map(String)).catch((error) => this.fail(error));
                }
                break;
            case "picture":
                this.shown = asShown(message);
                this.events.shown(this);
                break;
            case "trace":
                if (pixel)
                    this.events.trace(this, pixel);
                break;
            case "again":
                this.load();
                break;
            case "command":
            case "pick":
                this.answer(message.tidemark, message);
                break;
        }
    }

    /** Starts the server for these ancestors, and shows its page. */
    private async frame(origins: string[]): Promise<void> {
        const client = this.client();
        if (!client) {
            await run(["--version"], "/"); // fails with the advice for a missing program
            throw new Failure("the language server is not running");
        }
        const offered: string[] = client.initializeResult?.capabilities.executeCommandProvider?.commands ?? [];
        if (!offered.includes("tidemark.openPreview"))
            throw new Failure("this tidemark has no preview for editors: install a newer one");
        const loading = this.loading;
        const open = (origin: string[]) =>
            client.sendRequest<{ url: string }>("workspace/executeCommand", {
                command: "tidemark.openPreview",
                arguments: [this.scene.document.toString(), { ancestor: [...new Set(origins.map(ancestorOf))], origin }],
            });
        let [local, fragment] = (await open([])).url.split("#", 2);
        // Forwards the port where the editor's window is on another machine. The token, in the fragment, stays with us.
        const external = new URL((await vscode.env.asExternalUri(vscode.Uri.parse(local, true))).toString(true));
        if (!isLoopback(external.hostname))
            [local, fragment] = (await open([external.origin])).url.split("#", 2); // it keeps its port
        external.hash = fragment;
        const address = external.href;
        if (loading !== this.loading)
            return; // another load began meanwhile
        const nonce = makeNonce();
        const { origin } = external;
        this.panel.webview.html = document(
            `default-src 'none'; frame-src ${origin}; script-src 'nonce-${nonce}'; style-src 'nonce-${nonce}'`,
            nonce,
            `<iframe id="page" src="${escaped(address)}" allow="clipboard-write; fullscreen; autoplay" title="Tidemark"></iframe>
<script nonce="${nonce}">
const api = acquireVsCodeApi(), page = document.getElementById("page");
window.addEventListener("message", ({source, origin, data}) => {
    if (source === page.contentWindow) {
        if (origin !== "${origin}" || !data || !data.tidemark)
            return;
        if (data.tidemark === "key") // VS Code reads its shortcuts from events of this window; the frame has its own
            window.dispatchEvent(new KeyboardEvent("keydown", {bubbles: true, ...data}));
        else
            api.postMessage(data);
    } else if (data && data.tidemark) {
        if (data.tidemark === "pick")
            page.focus();
        page.contentWindow.postMessage(data, "${origin}");
    }
});
window.addEventListener("focus", () => page.focus());
</script>`,
        );
    }

    private fail(error: unknown): void {
        const nonce = makeNonce();
        const text = error instanceof Error ? error.message : String(error);
        this.panel.webview.html = document(
            `default-src 'none'; script-src 'nonce-${nonce}'; style-src 'nonce-${nonce}'`,
            nonce,
            `<p>There is no preview: ${escaped(text)}</p><button id="again">Try Again</button>
<script nonce="${nonce}">
const api = acquireVsCodeApi();
document.getElementById("again").onclick = () => api.postMessage({tidemark: "again"});
</script>`,
        );
        showFailure(error);
    }
}

/** The open previews, one for each scene, and the number in the status bar. */
export class Previews implements vscode.Disposable {
    private readonly open = new Map<string, Preview>();
    private readonly measured = new Map<string, Measured>();
    private readonly status = vscode.window.createStatusBarItem("tidemark.cost", vscode.StatusBarAlignment.Right, 100);

    constructor(
        private readonly client: () => LanguageClient | undefined,
        private readonly trace: (preview: Preview, pixel: Pixel) => void,
    ) {
        this.status.name = "Tidemark: Time of a Frame";
    }

    dispose(): void {
        this.status.dispose();
        [...this.open.values()].forEach((preview) => preview.panel.dispose());
    }

    show(scene: Scene): Preview {
        const known = this.open.get(scene.path);
        if (known) {
            known.panel.reveal(undefined, true);
            return known;
        }
        const panel = vscode.window.createWebviewPanel(
            k_view,
            `Preview ${path.basename(scene.path)}`,
            { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
            // A hidden panel is unloaded, so that nothing is drawn for it; the server keeps knobs and time.
            { enableScripts: true },
        );
        const preview = new Preview(scene, panel, this.client, { shown: (each) => this.showCost(each), trace: this.trace });
        this.open.set(scene.path, preview);
        panel.onDidDispose(() => {
            this.open.delete(scene.path);
            this.status.hide();
        });
        panel.onDidChangeViewState(() => panel.visible || this.status.hide());
        return preview;
    }

    of(scene: Scene): Preview | undefined {
        return this.open.get(scene.path);
    }

    /** Returns the preview that has the focus, or the only one on show. */
    active(): Preview | undefined {
        const all = [...this.open.values()];
        const visible = all.filter(({ panel }) => panel.visible);
        return all.find(({ panel }) => panel.active) ?? (visible.length === 1 ? visible[0] : undefined);
    }

    /** Loads all pages again, after the language server was started again. */
    reload(): void {
        this.open.forEach((preview) => preview.load());
    }

    /** Shows the error of a scene. */
    note(measured: Measured): void {
        this.measured.set(measured.scene, measured);
        this.open.forEach((preview) => this.showCost(preview));
    }

    private showCost(preview: Preview): void {
        const { shown } = preview;
        if (!shown || !preview.panel.visible)
            return;
        const bad = shown.bad === 1 ? "1 pixel" : `${shown.bad} pixels`;
        const { rmse, worst, why } = this.measured.get(realPath(preview.scene.path)) ?? {};
        const known = rmse !== undefined && worst !== undefined;
        const steps = (value: number) => (value > 0 && 255 * value < 0.01 ? "<0.01" : String(Number((255 * value).toPrecision(2))));
        this.status.text = `$(pulse) ${shown.draw.toFixed(1)} ms${known ? `, error ${steps(rmse)} of 255` : ""}` +
            (shown.bad ? ` $(warning) ${bad} not finite` : "");
        this.status.tooltip = `Tidemark draws a frame of ${path.basename(preview.scene.path)} at ${shown.size.join("×")} pixels in ` +
            `${shown.draw.toFixed(2)} ms; this one is frame ${shown.frame}, at ${shown.seconds.toFixed(2)} s.\n` +
            (known ? `Error of float against double at 0, 1 and 10 s: RMSE ${steps(rmse)} of 255, worst ${steps(worst)} of 255.`
                   : why ? `There is no error against double: ${why}.` : "The error against double is measured when the text rests.");
        this.status.show();
    }
}

/** Returns what frame-ancestors has to allow: an origin of the web, or the scheme of VS Code's own pages (vscode-webview:). */
const ancestorOf = (origin: string): string => (/^https?:/.test(origin) ? origin : `${origin.split(":", 1)[0]}:`);

/** Returns the path without links, as the language server names a scene. */
function realPath(file: string): string {
    try {
        return fs.realpathSync(file);
    } catch {
        return file; // it was removed
    }
}

const isLoopback = (host: string): boolean => /^(127\.[\d.]+|\[::1\]|(.*\.)?localhost)$/.test(host);

const makeNonce = (): string => randomBytes(16).toString("base64url");

function document(policy: string, nonce: string, body: string): string {
    return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${policy}">
<style nonce="${nonce}">
html, body { height: 100%; margin: 0; padding: 0; overflow: hidden; }
iframe { width: 100%; height: 100%; border: 0; display: block; }
.vscode-light iframe { color-scheme: light; } /* which the page in it then prefers */
.vscode-dark iframe { color-scheme: dark; }
p, button { margin: 1em; }
</style></head><body>
${body}
</body></html>`;
}

export const escaped = (text: string): string =>
    text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);

function asPixel(message: Message | undefined): Pixel | undefined {
    return isNumber(message?.x) && isNumber(message?.y) ? { x: Math.floor(message.x), y: Math.floor(message.y) } : undefined;
}

function asShown({ draw, seconds, frame, size, bad }: Message): Shown | undefined {
    if (!isNumber(draw) || !isNumber(seconds) || !isNumber(frame) || !Array.isArray(size) || !size.every(isNumber) || size.length !== 2)
        return undefined;
    return { draw, seconds, frame, size: [size[0], size[1]], bad: isNumber(bad) ? bad : 0 };
}
