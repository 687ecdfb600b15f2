import { create } from "@bufbuild/protobuf";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { SessionSchema, type Session } from "../src/gen/vsplit/v1/meshing_pb";
import { KeepAlive, pause } from "../src/page/keep_alive";

const ending = (seconds: number): Session => create(SessionSchema, { id: "s", expireTime: { seconds: BigInt(seconds) } });
const answer = (status: number, body: object): Response => new Response(JSON.stringify(body), { status });
const kept = (): Response => answer(200, { id: "s", expireTime: new Date(Date.now() + 30_000).toISOString() });

beforeEach(() => {
  vi.useFakeTimers();
  vi.setSystemTime(0);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

test("a third of what the session has, within bounds, whatever the clocks say", () => {
  expect(pause(ending(30), 0)).toBe(10_000);
  expect(pause(ending(1), 0)).toBe(1000);
  expect(pause(ending(-5000), 0)).toBe(1000);
  expect(pause(ending(3600), 0)).toBe(60_000);
});

test("the session that is open is kept alive again and again, another only while it is open", async () => {
  const calls: string[] = [];
  vi.stubGlobal("fetch", async (path: string) => (calls.push(path), kept()));
  const alive = new KeepAlive(() => expect.unreachable());
  alive.watch(ending(30));
  await vi.advanceTimersByTimeAsync(9_000);
  expect(calls).toEqual([]);
  await vi.advanceTimersByTimeAsync(22_000);
  expect(calls).toEqual(Array(3).fill("/v1/sessions/s:keepAlive"));
  alive.end();
  await vi.advanceTimersByTimeAsync(60_000);
  expect(calls.length).toBe(3);
});

test("where the server is away for a while, or refuses for a while, it is asked again, and that is told of once", async () => {
  const calls: number[] = [];
  const answers = [503, 429, 200, 503, 200];
  vi.stubGlobal("fetch", async () => {
    const status = answers[calls.length] ?? 200;
    calls.push(Date.now());
    if (status === 200) return kept();
    return answer(status, status === 503 ? { cause: "UNAVAILABLE", detail: "not now" } : { cause: "LIMIT_EXCEEDED", detail: "too many", retryAfter: 20 });
  });
  const told: unknown[] = [];
  const alive = new KeepAlive((problem) => told.push(problem));
  alive.watch(ending(30));
  await vi.advanceTimersByTimeAsync(70_000);
  alive.end();
  expect(calls.length).toBeGreaterThanOrEqual(5);
  expect(told).toEqual([{ cause: "UNAVAILABLE", detail: "not now" }, { cause: "UNAVAILABLE", detail: "not now" }].map((one) => expect.objectContaining(one)));
  expect(calls[2]! - calls[1]!).toBe(20_000);
});

test("a session that is gone is told of once", async () => {
  vi.stubGlobal("fetch", async () => answer(404, { cause: "NOT_FOUND", detail: "no session", status: 404, title: "NOT_FOUND" }));
  const lost: unknown[] = [];
  new KeepAlive((problem) => lost.push(problem)).watch(ending(30));
  await vi.advanceTimersByTimeAsync(100_000);
  expect(lost.length).toBe(1);
});
