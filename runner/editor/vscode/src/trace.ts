// `tidemark trace` of one pixel: the digits that each line keeps, at the end of that line.
import * as vscode from "vscode";
import { parse } from "./check";
import { placeOf } from "./places";
import type { Pixel } from "./preview";
import { deviceOption, errorText, Failure, runWithProgress } from "./program";
import { fileAt, folderOf, nameOf, saveFiles, Scene, wordOf } from "./scene";

type Value = number | string | null;

interface Line {
    file: string;
    line: number;
    digits: number;
    lost: number;
    fewest?: { name: string };
    not_finite?: { name: string };
}

interface Trace {
    pass: string;
    frame: number;
    pixel: [number, number];
    size: [number, number];
    colour: { float: Value[]; double: Value[]; digits: Value[] };
    lines: Line[];
}

/** A line whose values have fewer right digits than this is marked; a float has about 7.2. */
const k_few_digits = 3;

export class Traces implements vscode.Disposable {
    private readonly plain = decoration("editorCodeLens.foreground");
    private readonly poor = decoration("editorWarning.foreground");
    private readonly broken = decoration("editorError.foreground");
    private readonly shown = new Map<string, [vscode.TextEditorDecorationType, vscode.DecorationOptions[]][]>();
    private readonly subscriptions = [
        vscode.workspace.onDidChangeTextDocument(({ document, contentChanges }) => contentChanges.length && this.clear(document.uri)),
        vscode.window.onDidChangeVisibleTextEditors((editors) => editors.forEach((editor) => this.show(editor))),
    ];

    dispose(): void {
        [...this.subscriptions, this.plain, this.poor, this.broken].forEach((each) => each.dispose());
    }

    /** Traces a pixel at a moment, as options of `tidemark trace`, and writes the digits behind the lines. */
    async trace(scene: Scene, pixel: Pixel, moment: string[]): Promise<void> {
        await saveFiles(scene);
        const at = `${pixel.x},${pixel.y}`;
        const words = ["trace", wordOf(scene), ...moment, ...deviceOption(), "--pixel", at, "--json"];
        const outcome = await runWithProgress(`Tracing pixel ${at} of ${nameOf(scene)}`, words, folderOf(scene));
        if (!outcome)
            return;
        const trace = parse<Trace>(outcome.out);
        if (!trace)
            throw new Failure(errorText(outcome));
        [...this.shown.keys()].forEach((key) => this.clear(vscode.Uri.parse(key)));
        for (const line of trace.lines)
            await this.add(scene, line);
        // The scene's file comes to the front, so that the lines can be seen.
        const first = trace.lines.find(({ not_finite }) => not_finite) ?? trace.lines.find(({ lost }) => lost >= 1) ?? trace.lines[0];
        const uri = first ? fileAt(scene, first.file) : scene.document;
        const column = vscode.window.visibleTextEditors.find(({ document }) => document.uri.toString() === uri.toString())?.viewColumn;
        const editor = await vscode.window.showTextDocument(uri, { viewColumn: column ?? vscode.ViewColumn.One, preserveFocus: true });
        if (first)
            editor.revealRange(new vscode.Range(first.line - 1, 0, first.line - 1, 0), vscode.TextEditorRevealType.InCenterIfOutsideViewport);
        vscode.window.visibleTextEditors.forEach((each) => this.show(each));
        vscode.window.showInformationMessage(summaryOf(trace));
    }

    private async add(scene: Scene, line: Line): Promise<void> {
        const uri = fileAt(scene, line.file);
        const { end } = await placeOf(uri, line.line, 0, 0);
        const kind = line.not_finite ? this.broken : line.digits < k_few_digits || line.lost >= 1 ? this.poor : this.plain;
        const text = line.not_finite ? `${line.not_finite.name} is not finite`
                                     : `${line.digits.toFixed(1)} digits${line.fewest ? ` of ${line.fewest.name}` : ""}` +
                                       (line.lost >= 1 ? `, ${line.lost.toFixed(1)} lost here` : "");
        const key = uri.toString();
        const options = { range: new vscode.Range(end, end), renderOptions: { after: { contentText: text, margin: "0 0 0 3em" } } };
        this.shown.set(key, [...(this.shown.get(key) ?? []), [kind, [options]]]);
    }

    private show(editor: vscode.TextEditor): void {
        const all = this.shown.get(editor.document.uri.toString()) ?? [];
        for (const kind of [this.plain, this.poor, this.broken])
            editor.setDecorations(kind, all.filter(([each]) => each === kind).flatMap(([, options]) => options));
    }

    private clear(uri: vscode.Uri): void {
        if (!this.shown.delete(uri.toString()))
            return;
        vscode.window.visibleTextEditors.filter(({ document }) => document.uri.toString() === uri.toString()).forEach((each) => this.show(each));
    }
}

const decoration = (colour: string): vscode.TextEditorDecorationType =>
    vscode.window.createTextEditorDecorationType({ after: { color: new vscode.ThemeColor(colour), fontStyle: "italic" } });

/** Returns "Pixel 36,20 of 64x36, Image, frame 0: r 0.6256 (1.9 digits), …". */
function summaryOf({ pass, frame, pixel, size, colour }: Trace): string {
    const channels = ["r", "g", "b"].map((name, i) => {
        const value = colour.float[i];
        const digits = colour.digits[i];
        return typeof value === "number" ? `${name} ${value.toPrecision(4)} (${typeof digits === "number" ? digits.toFixed(1) : "?"} digits)`
                                         : `${name} ${value}`;
    });
    return `Pixel ${pixel.join(",")} of ${size.join("x")}, ${pass}, frame ${frame}: ${channels.join(", ")}`;
}
