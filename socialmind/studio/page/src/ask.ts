// Asking the program, outside the sockets of societies.

/** An answer of the program that says what is wrong. */
export class Refused extends Error {
  constructor(text: string, readonly exists: boolean) {
    super(text);
  }
}

/** No answer: the page says so by itself, and looks for the program. */
export class Unanswered extends Refused {}

/** Return what asks for something of a room; "" for what there is. */
export function asking(room: string) {
  return async <T>(what: string, asked?: unknown): Promise<T> => {
    let answer: Response;
    try {
      answer = await fetch(`api/${room}${what && "/"}${what}`, asked === undefined ? undefined : { method: "POST", body: JSON.stringify(asked) });
    } catch {
      throw new Unanswered("The program does not answer.", false);
    }
    // What guards the program refuses in plain words.
    if (answer.status === 403) throw new Refused((await answer.text()).trim(), false);
    const said = await answer.json().catch(() => ({ error: `The program failed (${answer.status}).` }));
    if (!answer.ok) throw new Refused(said.error, said.exists === true);
    return said as T;
  };
}
