import { expect, test } from "vitest";
import type { Order } from "../src/shared/protocol";
import { Orders } from "../src/worker/orders";

const faces = (n: number): Order => ({ kind: "faces", faces: n });
const drained = (orders: Orders): Order[] => {
  const all: Order[] = [];
  while (!orders.empty) all.push(orders.take()!);
  return all;
};

test("of resolutions that wait the last one is left, and each that goes is counted", () => {
  const orders = new Orders();
  expect([10, 20, 30].map((n) => orders.push(faces(n)))).toEqual([0, 1, 1]);
  expect(drained(orders)).toEqual([faces(30)]);
  expect(orders.push(faces(40))).toBe(0);
  expect(orders.take()).toEqual(faces(40));
  expect(orders.take()).toBeUndefined();
});

test("orders of other kinds stay, in their order", () => {
  const orders = new Orders();
  const cancel: Order = { kind: "cancel" }, red: Order = { kind: "colour", by: "stretch", range: [0, 1] }, size: Order = { kind: "colour", by: "size", range: [1, 2] };
  expect([faces(1), red, cancel, faces(2), size, cancel].map((order) => orders.push(order))).toEqual([0, 0, 0, 1, 1, 0]);
  expect(drained(orders)).toEqual([cancel, faces(2), size, cancel]);
});
