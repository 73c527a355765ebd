// `tidemark check` as problems of the editor.
import * as vscode from "vscode";
import { placeOf } from "./places";
import { checkSeconds, deviceOption, errorText, Failure, run, runWithProgress } from "./program";
import { fileAt, folderOf, nameOf, saveFiles, Scene, wordOf } from "./scene";

export const k_source = "tidemark check";
export const k_help = "tidemark-help";

/** One line of `--diagnostics json`; columns count bytes from 1, and 0 is unknown. */
export interface Printed {
    file: string;
    line: number;
    column: number;
    end_column: number;
    severity: "error" | "warning" | "note";
    rule: string;
    message: string;
}

interface Finding {
    level: string;
    message: string;
    places: { file: string; line: number }[];
    probes: string[];
    try?: string;
    see?: string;
}

const k_severities = {
    error: vscode.DiagnosticSeverity.Error,
    warning: vscode.DiagnosticSeverity.Warning,
    note: vscode.DiagnosticSeverity.Information,
};

/** The findings of the last check of each scene. */
export class Findings implements vscode.Disposable {
    private readonly board = vscode.languages.createDiagnosticCollection(k_source);
    private readonly files = new Map<string, vscode.Uri[]>();
    private readonly subscription = vscode.workspace.onDidChangeTextDocument((event) => this.follow(event));

    dispose(): void {
        this.subscription.dispose();
        this.board.dispose();
    }

    /** Checks a scene and puts its findings into the Problems panel; returns how many there are, undefined after a cancel. */
    async check(scene: Scene): Promise<number | undefined> {
        await saveFiles(scene);
        const words = ["check", wordOf(scene), ...deviceOption(), "--budget", String(checkSeconds()), "--json", "--diagnostics", "json"];
        const outcome = await runWithProgress(`Checking ${nameOf(scene)}, at most ${checkSeconds()} s`, words, folderOf(scene));
        if (!outcome)
            return undefined;
        const printed = readPrinted(outcome.err);
        if (outcome.code === 3)
            throw new Failure(`${nameOf(scene)} does not compile: correct the errors in the Problems panel first`);
        const report = parse<{ findings: Finding[] }>(outcome.out);
        if (!report)
            throw new Failure(printed.map(({ message }) => message).join("\n") || errorText(outcome));
        const known = printed.filter(({ rule }) => rule !== "scene");
        await this.show(scene, known, report.findings);
        const cut = outcome.code === 5 ? "; time ran out before all probes had answered (setting tidemark.checkSeconds)" : "";
        const count = known.length === 1 ? "1 finding" : `${known.length || "no"} findings`;
        const show = known.some(({ severity }) => severity === "error") ? vscode.window.showWarningMessage
                                                                         : vscode.window.showInformationMessage;
        show(`Check of ${nameOf(scene)}: ${count}${cut}`, ...(known.length ? ["Show Problems"] : [])).then(
            (answer) => answer && vscode.commands.executeCommand("workbench.actions.view.problems"),
        );
        return known.length;
    }

    private async show(scene: Scene, printed: Printed[], findings: Finding[]): Promise<void> {
        const lines = await helpLines("probes", folderOf(scene));
        const found = new Map<string, { uri: vscode.Uri; all: vscode.Diagnostic[] }>();
        for (const each of printed) {
            const finding = findings.find(({ message }) => message === each.message);
            const uri = fileAt(scene, each.file);
            const range = await placeOf(uri, each.line, each.column, each.end_column);
            const advice = finding?.try ? `\nTry: ${finding.try}` : finding?.see ? `\nSee: ${finding.see}` : "";
            const diagnostic = new vscode.Diagnostic(range, each.message + advice, k_severities[each.severity]);
            diagnostic.source = k_source;
            const line = lines.findIndex((text) => text.trim().startsWith(`\`${each.rule}\``)) + 1;
            diagnostic.code = { value: each.rule, target: vscode.Uri.from({ scheme: k_help, path: "/probes.txt", fragment: `L${line || 1}` }) };
            diagnostic.relatedInformation = [];
            for (const place of finding?.places ?? [])
                if (place.line !== each.line || place.file !== each.file) {
                    const other = fileAt(scene, place.file);
                    const location = new vscode.Location(other, await placeOf(other, place.line, 0, 0));
                    diagnostic.relatedInformation.push(new vscode.DiagnosticRelatedInformation(location, "also here"));
                }
            const key = uri.toString();
            found.set(key, { uri, all: [...(found.get(key)?.all ?? []), diagnostic] });
        }
        this.files.get(scene.path)?.forEach((uri) => this.board.delete(uri));
        this.files.set(scene.path, [...found.values()].map(({ uri }) => uri));
        found.forEach(({ uri, all }) => this.board.set(uri, all));
    }

    /** Moves findings with the text, and takes away those on lines that are edited. */
    private follow({ document, contentChanges }: vscode.TextDocumentChangeEvent): void {
        let all = [...(this.board.get(document.uri) ?? [])];
        if (all.length === 0 || contentChanges.length === 0)
            return;
        for (const { range, text } of contentChanges) {
            all = all.filter((each) => each.range.end.line < range.start.line || each.range.start.line > range.end.line);
            const added = text.split("\n").length - 1 - (range.end.line - range.start.line);
            for (const each of all)
                if (each.range.start.line > range.end.line)
                    each.range = new vscode.Range(each.range.start.translate(added), each.range.end.translate(added));
        }
        this.board.set(document.uri, all);
    }
}

/** Reads the lines of `--diagnostics json`; other lines are left out. */
export const readPrinted = (err: string): Printed[] =>
    err.split("\n").map((line) => (line.startsWith("{") ? parse<Printed>(line) : undefined)).filter((each) => each !== undefined);

export function parse<T>(text: string): T | undefined {
    try {
        return JSON.parse(text) as T;
    } catch {
        return undefined;
    }
}

const pages = new Map<string, Promise<string>>();

/** Returns a page of `tidemark help`, read once. */
export function helpPage(topic: string, folder: string): Promise<string> {
    const page = pages.get(topic) ?? run(["help", topic], folder).then(({ out }) => out);
    pages.set(topic, page);
    page.catch(() => pages.delete(topic));
    return page;
}

const helpLines = async (topic: string, folder: string): Promise<string[]> =>
    (await helpPage(topic, folder).catch(() => "")).split("\n");
