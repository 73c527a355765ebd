// Places of the program (lines and columns from 1, columns in bytes) as ranges of the editor.
import * as vscode from "vscode";

/** Returns the range of a place. Column 0, or an end of 0, is the rest of the line without its blanks; line 0 is the first. */
export async function placeOf(uri: vscode.Uri, line: number, column: number, endColumn: number): Promise<vscode.Range> {
    const at = Math.max(0, line - 1);
    let text: string;
    try {
        const document = await vscode.workspace.openTextDocument(uri);
        if (at >= document.lineCount)
            return new vscode.Range(document.lineCount - 1, 0, document.lineCount - 1, 0);
        text = document.lineAt(at).text;
    } catch {
        return new vscode.Range(at, 0, at, 0); // not a text
    }
    const indent = text.length - text.trimStart().length;
    const begin = column > 0 ? unitsBefore(text, column) : indent;
    const end = endColumn > column && column > 0 ? unitsBefore(text, endColumn) : text.trimEnd().length;
    return new vscode.Range(at, begin, at, Math.max(begin, end));
}

/** Returns how many UTF-16 units are before a column in bytes from 1. */
export const unitsBefore = (text: string, column: number): number =>
    Buffer.from(text, "utf8").subarray(0, column - 1).toString("utf8").length;
