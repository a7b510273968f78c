// SPDX-License-Identifier: Apache-2.0
// Runs the validator of the Khronos Group over files: node validate_gltf.js MODULE FILE... prints a line for each error and
// warning, and how many files had none.
const fs = require('fs');
const [module_path, ...files] = process.argv.slice(2);
const validator = require(module_path);

const check = async (file) => {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 20});
  const bad = report.issues.messages.filter((one) => one.severity <= 1);
  for (const one of bad) console.log(`${file}: ${one.code} ${one.pointer}: ${one.message}`);
  return bad.length === 0 && report.issues.numErrors === 0 && report.issues.numWarnings === 0;
};
Promise.all(files.map(check)).then((fine) => console.log(`${fine.filter(Boolean).length} files are fine`));
