// A call of the library that failed: message is the library's own, code the name of its result.
export class NookError extends Error {
  constructor(message, code) {
    super(message);
    this.name = "NookError";
    this.code = code;
  }
}
