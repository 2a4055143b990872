// node validate.mjs FILE...: runs Khronos's validator. Fails if a file has an error.

import { readFile } from 'node:fs/promises';
import { validateBytes } from 'gltf-validator';

let failed = false;
for (const path of process.argv.slice(2)) {
  const report = await validateBytes(new Uint8Array(await readFile(path)), { maxIssues: 20 });
  const { numErrors, numWarnings, messages } = report.issues;
  console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings`);
  for (const { severity, code, message, pointer } of messages.filter(({ severity }) => severity < 2)) {
    console.log(`  ${severity ? 'warning' : 'error'} ${code} ${pointer}: ${message}`);
  }
  failed ||= numErrors > 0;
}
process.exit(failed ? 1 : 0);
