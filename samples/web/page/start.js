// Starts the page. If that is not possible, says why: a file is missing, an answer is cut off, or a policy forbids it.
(() => {
  const message = document.getElementById("message"), text = document.getElementById("message_text");
  const show = (sentence, isError) => {
    text.textContent = sentence;
    message.classList.toggle("error", isError);
    message.setAttribute("role", isError ? "alert" : "status");
    message.hidden = !sentence;
  };
  globalThis.nookMessage = {
    progress: (sentence) => !message.classList.contains("error") && show(sentence, false),
    clear: () => show("", false),
    report(error) {
      const reason = error?.message ?? String(error);
      // If a script is cut off, or the server sends a page in its place, the error is a SyntaxError.
      show(error instanceof SyntaxError || /dynamically imported module|module script|Failed to resolve module|error loading/i.test(reason)
        ? `A script of the page cannot be loaded (${reason}). Is the folder complete, and does the server's content security policy allow its own scripts?`
        : reason, true);
      console.error(error);
    },
  };
  // Requests the files that index.html preloads, before the other scripts have loaded.
  const early = new Map(["node_modules/nook-web/nook.wasm", "data/character.json", "data/character.bin", "data/character.nook"]
    .map((url) => [url, fetch(url)]));
  for (const answer of early.values()) answer.catch(() => {});  // the code that needs the file reports the error
  globalThis.nookFetch = (url) => {
    const answer = early.get(url) ?? fetch(url);
    early.delete(url);
    return answer;
  };
  addEventListener("unhandledrejection", ({ reason }) => globalThis.nookMessage.report(reason));
  globalThis.nookMessage.progress("Loading the page's scripts …");
  import("./main.js").catch(globalThis.nookMessage.report);
})();
