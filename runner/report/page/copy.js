// A button beside each command.
for (const command of document.querySelectorAll(".command")) {
    const button = document.createElement("button");
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
        const text = command.querySelector("code").textContent;
        const copied = await navigator.clipboard.writeText(text).then(() => true, () => false);
        if (!copied) // this browser lets no page of a file write there: the person can
            getSelection().selectAllChildren(command.querySelector("code"));
        button.textContent = copied ? "Copied" : "Selected";
    });
    command.append(button);
}
