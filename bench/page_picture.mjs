// page_picture.mjs VSPLITD DATA OUT_DIR: pictures of the page for docs, page.jpg and page_dark.jpg.
import { join } from "node:path";
import { openPage, run, settled, startServer, upload } from "../tests/e2e/page/browser.mjs";

const [vsplitd, data, out] = process.argv.slice(2);
const server = await startServer(vsplitd);
const { browser, page } = await openPage(server.address, { width: 1440, height: 860 });
await page.selectOption("#unit", "MILLIMETRE");
await upload(page, join(data, "crankshaft.stl"));
await run(page, "improve", { subdivisionSize: 8, tolerance: 1, faces: 30000 });
await settled(page, 300000);
await page.waitForTimeout(1500);
await page.screenshot({ path: join(out, "page.jpg"), type: "jpeg", quality: 82 });
await page.click("#theme");
await page.selectOption("#view", "result");
await page.selectOption("#cut-axis", "0");
await page.waitForTimeout(1500);
await page.screenshot({ path: join(out, "page_dark.jpg"), type: "jpeg", quality: 82 });
await browser.close();
await server.stop();
