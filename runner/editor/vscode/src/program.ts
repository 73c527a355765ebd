// Runs the program `tidemark`, returns its output, and explains its errors. A missing program gets a message that says how to install it.
import { spawn } from "node:child_process";
import { homedir } from "node:os";
import * as path from "node:path";
import * as vscode from "vscode";

export interface Outcome {
    /** The exit code; null if a signal ended the program. */
    code: number | null;
    out: string;
    err: string;
    cancelled: boolean;
}

/** Thrown if the program cannot be started. */
export class MissingProgram extends Error {}

/** An expected failure; the user reads its message. */
export class Failure extends Error {}

const settings = () => vscode.workspace.getConfiguration("tidemark");

export function programPath(): string {
    const given = settings().get<string>("path", "").trim() || "tidemark";
    return given === "~" || given.startsWith("~/") ? path.join(homedir(), given.slice(1)) : given;
}

/** Returns the option that selects the device, for commands that draw. */
export function deviceOption(): string[] {
    const device = settings().get<string>("device", "auto").trim();
    return device === "" || device === "auto" ? [] : ["--device", device];
}

/** Returns the option that limits what the language server measures in the background. */
export function measureOption(): string[] {
    const seconds = settings().inspect<number>("measureSeconds")?.defaultValue;
    const wanted = settings().get<number>("measureSeconds");
    return wanted === undefined || wanted === seconds ? [] : ["--measure", String(Math.max(0, wanted))];
}

export const checkSeconds = (): number => Math.max(1, settings().get<number>("checkSeconds", 60));

/**
 * Runs the program to its end and returns its output. Cancelling sends the signal of Ctrl-C.
 * @param onLine is called with each line of standard error.
 */
export function run(
    words: string[],
    folder: string,
    { cancel, onLine }: { cancel?: vscode.CancellationToken; onLine?: (line: string) => void } = {},
): Promise<Outcome> {
    return new Promise((resolve, reject) => {
        const child = spawn(programPath(), words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
        const out: Buffer[] = [];
        let err = "";
        let rest = "";
        child.stdout.on("data", (data: Buffer) => out.push(data));
        child.stderr.setEncoding("utf8");
        child.stderr.on("data", (text: string) => {
            err += text;
            const lines = (rest + text).split("\n");
            rest = lines.pop() ?? "";
            lines.forEach((line) => onLine?.(line));
        });
        const subscription = cancel?.onCancellationRequested(() => child.kill("SIGINT"));
        child.on("error", (error: NodeJS.ErrnoException) => {
            subscription?.dispose();
            const missing = error.code === "ENOENT" || error.code === "EACCES";
            reject(missing ? new MissingProgram(`${programPath()}: ${error.code}`) : error);
        });
        child.on("close", (code) => {
            subscription?.dispose();
            resolve({ code, out: Buffer.concat(out).toString("utf8"), err, cancelled: !!cancel?.isCancellationRequested });
        });
    });
}

/** Runs the program with a notification that shows its progress and a Cancel button; undefined after a cancel. */
export async function runWithProgress(title: string, words: string[], folder: string): Promise<Outcome | undefined> {
    const outcome = await vscode.window.withProgress(
        { location: vscode.ProgressLocation.Notification, title, cancellable: true },
        (progress, cancel) => {
            let shown = 0;
            return run(words, folder, {
                cancel,
                // "24/39 frames, 10.5 a second, 1 s left"
                onLine: (line) => {
                    const count = /^(\d+)\/(\d+) .*/.exec(line);
                    if (!count)
                        return;
                    const percent = (100 * Number(count[1])) / Number(count[2]);
                    // A command may count several things, one after the other.
                    progress.report({ message: line, increment: Math.max(0, percent - shown) });
                    shown = percent;
                },
            });
        },
    );
    return outcome.cancelled ? undefined : outcome;
}

/** Returns the errors that a command printed, without its progress and its name. */
export function errorText({ err, code }: Outcome): string {
    const lines = err.split("\n").map((line) => line.replace(/^tidemark: (error: )?/, ""));
    const text = lines.filter((line) => line.trim() !== "" && !/^\d+\/\d+ |^warning: /.test(line)).join("\n");
    return text || `tidemark ended with exit code ${code}`;
}

/** Shows why something failed. A missing program gets the buttons that help. */
export async function showFailure(error: unknown): Promise<void> {
    if (!(error instanceof MissingProgram)) {
        vscode.window.showErrorMessage(`Tidemark: ${error instanceof Error ? error.message : String(error)}`);
        return;
    }
    const open = "Open Settings";
    const how = "How to Install";
    const where = vscode.env.remoteName ? "on the remote machine" : "on this machine";
    const answer = await vscode.window.showErrorMessage(
        `The program '${programPath()}' was not found ${where}. Install Tidemark (./dev package in its source makes a package ` +
            "for apt), or give the file of the program in the setting tidemark.path.",
        open,
        how,
    );
    if (answer === open)
        await vscode.commands.executeCommand("workbench.action.openSettings", "tidemark.path");
    if (answer === how)
        await vscode.commands.executeCommand("extension.open", "tidemark.tidemark");
}
