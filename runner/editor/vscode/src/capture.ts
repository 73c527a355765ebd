// A still of what the preview shows, and a video by a form.
import { randomBytes } from "node:crypto";
import * as path from "node:path";
import * as vscode from "vscode";
import { escaped, Preview } from "./preview";
import { deviceOption, errorText, Failure, runWithProgress, showFailure } from "./program";
import { folderOf, nameOf, outputOf, saveFiles, Scene, wordOf } from "./scene";
import { momentOptions, sceneOptions, valueOf } from "./words";

/** Captures the moment that the preview shows, without one a time that the user gives, into SCENE.png. */
export async function captureStill(scene: Scene, preview: Preview | undefined): Promise<string | undefined> {
    await saveFiles(scene);
    let options = await preview?.moment().then((words) => words && momentOptions(words));
    if (preview && !options)
        throw new Failure("the preview shows no picture yet, or another viewer controls it");
    if (!options) {
        const time = await vscode.window.showInputBox({
            title: "Capture a Still",
            prompt: "Time in seconds (an open preview gives its own moment)",
            value: "0",
            validateInput: (text) => (isPositive(text, true) ? undefined : "Give a number of seconds, such as 2.5"),
        });
        if (time === undefined)
            return undefined;
        options = ["--time", time.trim()];
    }
    const file = outputOf(scene, ".png");
    return write(scene, file, "Capturing", ["capture", wordOf(scene), ...options, ...deviceOption(), "-o", file]);
}

/** Runs a command that writes a file, and offers to open it; shows the command's warnings. Undefined after a cancel. */
export async function write(scene: Scene, file: string, verb: string, words: string[]): Promise<string | undefined> {
    const outcome = await runWithProgress(`${verb} ${path.basename(file)}`, words, folderOf(scene));
    if (!outcome)
        return undefined;
    if (outcome.code !== 0)
        throw new Failure(errorText(outcome));
    const warnings = outcome.err.split("\n").filter((line) => line.startsWith("warning: "));
    const text = [`Wrote ${path.basename(file)}`, ...warnings].join("; ");
    const show = warnings.length ? vscode.window.showWarningMessage : vscode.window.showInformationMessage;
    show(text, "Open").then((answer) => answer && vscode.commands.executeCommand("vscode.open", vscode.Uri.file(file)));
    return file;
}

const isPositive = (text: string, zero = false): boolean => {
    const number = Number(text);
    return text.trim() !== "" && Number.isFinite(number) && (number > 0 || (zero && number === 0));
};

/** The fields of the form, as texts. */
interface Wanted {
    size: string;
    from: string;
    duration: string;
    fps: string;
    samples: string;
    ending: string;
}

const k_endings = [".mp4", ".webm", ".mov", ".gif", ".webp", ".mkv"];
const k_first: Wanted = { size: "1280x720", from: "0", duration: "5", fps: "30", samples: "1", ending: ".mp4" };

/** Returns what is wrong with a field, as a sentence; undefined if all are good. */
function faultIn(wanted: Wanted): string | undefined {
    if (!/^[1-9]\d{0,4}x[1-9]\d{0,4}$/.test(wanted.size))
        return "Size: give width and height in pixels, such as 1280x720.";
    if (!isPositive(wanted.from, true))
        return "From: give a time in seconds, such as 0.";
    if (!isPositive(wanted.duration))
        return "Duration: give a time in seconds, such as 5.";
    if (!/^\d+(\.\d+)?$|^[1-9]\d*\/[1-9]\d*$/.test(wanted.fps) || Number(wanted.fps) === 0)
        return "Rate: give frames per second, such as 30 or 24000/1001.";
    if (!/^[1-9]\d{0,3}$/.test(wanted.samples))
        return "Samples: give a whole number from 1.";
    return k_endings.includes(wanted.ending) ? undefined : "Choose a format.";
}

/** Shows the form of a video. Its fields are kept for the next one. */
export async function captureVideo(scene: Scene, preview: Preview | undefined, memory: vscode.Memento): Promise<void> {
    const words = (await preview?.moment()) ?? [];
    const size = valueOf(words, "--size");
    const first: Wanted = { ...k_first, ...(size ? { size } : {}), ...memory.get<Partial<Wanted>>("video") };
    const panel = vscode.window.createWebviewPanel("tidemark.video", `Video of ${nameOf(scene)}`, vscode.ViewColumn.Active, {
        enableScripts: true,
    });
    panel.webview.html = form(scene, first);
    let running = false;
    panel.webview.onDidReceiveMessage(async (message: { wanted?: Wanted }) => {
        if (!message?.wanted || running)
            return;
        const wanted = message.wanted;
        const fault = faultIn(wanted);
        const tell = (text: string) => panel.webview.postMessage({ text, running }).then(undefined, () => undefined);
        if (fault)
            return void tell(fault);
        running = true;
        tell("Capturing; the notification shows the progress and has the Cancel button.");
        let text = "";
        try {
            await memory.update("video", wanted);
            const file = await writeVideo(scene, wanted, sceneOptions(words));
            text = file ? `Wrote ${file}` : "Cancelled; no file was written.";
        } catch (error) {
            text = error instanceof Error ? error.message : String(error);
            showFailure(error);
        }
        running = false;
        tell(text);
    });
}

async function writeVideo(scene: Scene, wanted: Wanted, options: string[]): Promise<string | undefined> {
    await saveFiles(scene);
    const file = outputOf(scene, wanted.ending);
    const samples = wanted.samples === "1" ? [] : ["--samples", wanted.samples];
    const words = ["capture", wordOf(scene), ...options, ...deviceOption(), "--size", wanted.size, "--from", wanted.from, "--duration",
                   wanted.duration, "--fps", wanted.fps, ...samples, "--pad", "even", "-o", file];
    return write(scene, file, "Capturing", words);
}

function form(scene: Scene, first: Wanted): string {
    const nonce = randomBytes(16).toString("base64url");
    const field = (name: keyof Wanted, label: string, hint: string) =>
        `<label>${label}<input name="${name}" value="${escaped(first[name])}"><small>${hint}</small></label>`;
    const endings = k_endings.map((each) => `<option${each === first.ending ? " selected" : ""}>${each}</option>`).join("");
    return `<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'nonce-${nonce}'; style-src 'nonce-${nonce}'">
<style nonce="${nonce}">
form { display: grid; gap: 0.8em; max-width: 34em; }
label { display: grid; grid-template-columns: 7em 9em 1fr; gap: 1em; align-items: center; }
input, select { font: inherit; padding: 4px; color: var(--vscode-input-foreground); background: var(--vscode-input-background);
    border: 1px solid var(--vscode-input-border, var(--vscode-contrastBorder, transparent)); }
button { font: inherit; justify-self: start; padding: 6px 14px; border: 0; color: var(--vscode-button-foreground);
    background: var(--vscode-button-background); }
button:disabled { opacity: 0.5; }
small { color: var(--vscode-descriptionForeground); }
</style></head><body>
<h1>Video of ${escaped(nameOf(scene))}</h1>
<form>
${field("size", "Size", "width x height in pixels")}
${field("from", "From", "seconds of the scene")}
${field("duration", "Duration", "seconds")}
${field("fps", "Rate", "frames per second")}
${field("samples", "Samples", "for each pixel: more are smoother and slower")}
<label>Format<select name="ending">${endings}</select><small>needs ffmpeg</small></label>
<button>Capture</button>
<output></output>
</form>
<script nonce="${nonce}">
const api = acquireVsCodeApi(), form = document.querySelector("form");
form.onsubmit = event => {
    event.preventDefault();
    api.postMessage({wanted: Object.fromEntries(new FormData(form))});
};
window.onmessage = ({data}) => {
    form.querySelector("output").textContent = data.text;
    form.querySelector("button").disabled = data.running;
};
</script></body></html>`;
}
