import { fromJson, type DescMessage, type JsonValue, type MessageShape } from "@bufbuild/protobuf";
import { RepresentationSchema, SessionSchema, type Representation, type Session } from "../gen/vsplit/v1/meshing_pb";
import { fields } from "../shared/access";
import { problemFrom, problemOf, unreachable } from "../shared/problem";

export interface UploadOptions {
  repair: string;
  weld: number;
  /** A LengthUnit's name; empty: as the file says. */
  unit: string;
}

function read<Schema extends DescMessage>(schema: Schema, json: JsonValue): MessageShape<Schema> {
  return fromJson(schema, json, { ignoreUnknownFields: true });
}

async function get<Schema extends DescMessage>(schema: Schema, path: string): Promise<MessageShape<Schema>> {
  const response = await fetch(path, { headers: fields() });
  if (!response.ok) throw await problemOf(response);
  return read(schema, (await response.json()) as JsonValue);
}

/** Creates a session with a mesh. XMLHttpRequest, since fetch does not tell how much has gone out. */
export function upload(file: Blob, options: UploadOptions, sent: (share: number) => void, signal: AbortSignal): Promise<Session> {
  const query = new URLSearchParams({ repair: options.repair, weld: String(options.weld) });
  if (options.unit) query.set("unit", options.unit);
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open("POST", `/v1/sessions?${query}`);
    for (const [name, value] of Object.entries(fields({ "Content-Type": "application/octet-stream" }))) request.setRequestHeader(name, value);
    request.upload.onprogress = (event) => sent(event.total > 0 ? event.loaded / event.total : 0);
    request.onload = () => {
      if (request.status === 200) resolve(read(SessionSchema, JSON.parse(request.responseText) as JsonValue));
      else reject(problemFrom(request.status, request.responseText));
    };
    request.onerror = () => reject(unreachable);
    request.onabort = () => reject(new DOMException("cancelled", "AbortError"));
    signal.addEventListener("abort", () => request.abort());
    request.send(file);
  });
}

/** A representation with the figures and bounds of one of its resolutions. */
export async function representationAt(session: string, representation: string, faces: number, signal: AbortSignal): Promise<Representation> {
  const headers = fields({ "Content-Type": "application/json", Accept: "application/json" });
  const body = JSON.stringify({ representation, faces });
  const response = await fetch(`/v1/sessions/${encodeURIComponent(session)}:setResolution`, { method: "POST", headers, body, signal });
  if (!response.ok) throw await problemOf(response);
  return read(RepresentationSchema, (await response.json()) as JsonValue);
}

/** Puts off when the session expires. */
export async function keepAlive(id: string): Promise<Session> {
  const response = await fetch(`/v1/sessions/${encodeURIComponent(id)}:keepAlive`, { method: "POST", headers: fields() });
  if (!response.ok) throw await problemOf(response);
  return read(SessionSchema, (await response.json()) as JsonValue);
}

export const getSession = (id: string): Promise<Session> => get(SessionSchema, `/v1/sessions/${encodeURIComponent(id)}`);

export async function deleteSession(id: string): Promise<void> {
  const response = await fetch(`/v1/sessions/${encodeURIComponent(id)}`, { method: "DELETE", headers: fields() });
  if (!response.ok) throw await problemOf(response);
}

/** Where a mesh file is. `representation` "" is the upload. */
export function meshPath(session: string, representation: string, faces: number, format: string): string {
  const query = new URLSearchParams({ format });
  if (representation) query.set("representation", representation);
  if (representation && faces > 0) query.set("faces", String(faces));
  return `/v1/sessions/${session}/mesh?${query}`;
}
