// Commands that write a file or a folder and show it: study, export, import; and pages of the manual.
import * as fs from "node:fs";
import * as path from "node:path";
import * as vscode from "vscode";
import { helpPage } from "./check";
import { write } from "./capture";
import { deviceOption, errorText, Failure, run, runWithProgress } from "./program";
import { folderOf, nameOf, outputOf, saveFiles, Scene, wordOf } from "./scene";
import { freeName } from "./words";

/** Studies a scene into a folder SCENE-study beside it, and shows the report. */
export async function study(scene: Scene): Promise<void> {
    await saveFiles(scene);
    const folder = outputOf(scene, "-study");
    const words = ["study", wordOf(scene), ...deviceOption(), "-o", folder];
    const outcome = await runWithProgress(`Studying ${nameOf(scene)}`, words, folderOf(scene));
    if (!outcome)
        return;
    const report = path.join(folder, "report.html");
    if (outcome.code !== 0 || !fs.existsSync(report))
        throw new Failure(errorText(outcome));
    const panel = vscode.window.createWebviewPanel("tidemark.report", `Study of ${nameOf(scene)}`, vscode.ViewColumn.Active, {
        enableScripts: true,
        localResourceRoots: [],
    });
    // The report is one file that loads nothing: styles, scripts and pictures are in it.
    const policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
    const text = await fs.promises.readFile(report, "utf8");
    panel.webview.html = text.replace(/<head>/i, `<head><meta http-equiv="Content-Security-Policy" content="${policy}">
<style>body { background: #fff; color: #000; }</style>`);
}

/** Writes the scene as a page that draws it in any browser. */
export async function exportPage(scene: Scene): Promise<string | undefined> {
    await saveFiles(scene);
    const target = await vscode.window.showSaveDialog({
        defaultUri: vscode.Uri.file(outputOf(scene, ".html")),
        filters: { "Web page": ["html"] },
        title: "Export as a Page",
    });
    if (!target)
        return undefined;
    return write(scene, target.fsPath, "Exporting", ["export", wordOf(scene), "--html", target.fsPath]);
}

/** Makes a scene folder from a project of ShaderToy, beside its file, and opens its image. */
export async function importProject(): Promise<string | undefined> {
    const active = vscode.window.activeTextEditor?.document.uri;
    const [file] = (await vscode.window.showOpenDialog({
        defaultUri: active?.scheme === "file" ? active : undefined,
        filters: { "ShaderToy project or saved page": ["json", "html", "htm"] },
        title: "Import ShaderToy JSON",
    })) ?? [];
    if (!file)
        return undefined;
    const around = path.dirname(file.fsPath);
    const stem = path.basename(file.fsPath).replace(/\.\w+$/, "");
    const folder = path.join(around, freeName(stem, "", (name) => fs.existsSync(path.join(around, name))));
    const outcome = await run(["import", path.basename(file.fsPath).replace(/^-/, "./-"), "-o", folder, "--json"], around);
    if (outcome.code !== 0)
        throw new Failure(errorText(outcome));
    await vscode.window.showTextDocument(vscode.Uri.file(path.join(folder, "image.glsl")));
    tellImported(folder, outcome.err);
    return folder;
}

function tellImported(folder: string, err: string): void {
    const warnings = err.split("\n").filter((line) => line.startsWith("warning: "));
    const text = [`Imported into ${path.basename(folder)}`, ...warnings].join("; ");
    (warnings.length ? vscode.window.showWarningMessage : vscode.window.showInformationMessage)(text);
}

/** Shows `tidemark help TOPIC` for addresses such as tidemark-help:/probes.txt. */
export const manual: vscode.TextDocumentContentProvider = {
    provideTextDocumentContent: (uri) =>
        helpPage(path.basename(uri.path, ".txt"), "/").catch(() => "The program tidemark was not found: see the setting tidemark.path."),
};
