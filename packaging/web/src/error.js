// The error of a failed call: `message` is the library's message, and `code` is the name of the result.
export class NookError extends Error {
  constructor(message, code) {
    super(message);
    this.name = "NookError";
    this.code = code;
  }
}
