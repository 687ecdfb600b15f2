/** The bearer token that a guarded server asks for; "" for none. Each worker has its own copy. */
export const access = { token: "" };

/** Fields of a request, with the token where there is one. */
export function fields(others: Record<string, string> = {}): Record<string, string> {
  return access.token === "" ? others : { ...others, Authorization: `Bearer ${access.token}` };
}
