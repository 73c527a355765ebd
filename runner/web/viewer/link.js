// ---- The connection to the program

// Texts go both ways. A picture comes as four bytes of length, a JSON head of that length, and a JPEG file.
class Link {
    // Returns the token of the page's address as a query, from the fragment (which editors escape) or from the query itself.
    static get query() {
        const [, token] = location.hash.replace(/%3d/i, "=").match(/^#token=([\w-]+)$/) ?? [];
        return token ? `?token=${token}` : location.search;
    }

    constructor({onText, onPicture, onEnd}) {
        const address = new URL("socket", location.href);
        address.protocol = address.protocol.replace("http", "ws");
        address.search = Link.query;
        this.socket = new WebSocket(address);
        this.socket.binaryType = "arraybuffer";
        this.socket.onmessage = ({data}) => typeof data === "string" ? onText(JSON.parse(data)) : onPicture(...Link.parts(data));
        this.socket.onclose = ({reason}) => onEnd(reason);
    }

    static parts(buffer) {
        const length = new DataView(buffer).getUint32(0, true);
        const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
        return [head, new Uint8Array(buffer, 4 + length)];
    }

    send(wanted, values = {}) {
        if (this.socket.readyState === WebSocket.OPEN)
            this.socket.send(JSON.stringify({do: wanted, ...values}));
    }
}

