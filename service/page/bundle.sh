#!/usr/bin/env bash
# Bundles src/ with three.js and uPlot into bundle/, which the program is built from. Needs npm.
# With --check: exit code 1 if bundle/ is not what the sources give, 77 without npm.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
out=bundle
if [[ ${1-} == --check ]]; then
  command -v npm >/dev/null || { echo "no npm: not checked"; exit 77; }
  out=$(mktemp -d)
  trap 'rm -rf -- "$out"' EXIT
fi
[[ -d node_modules ]] || npm ci --no-audit --no-fund --silent
for page in report service preview; do
  npx esbuild src/$page.js --bundle --minify --format=iife --target=chrome100,firefox113,safari16.4 --legal-comments=none \
    --log-level=warning --outfile="$out/$page.min.js"
done
for page in report service; do
  npx esbuild src/$page.css --bundle --minify --log-level=warning --outfile="$out/$page.min.css"
done
{
  echo "These pages contain three.js and uPlot."
  for package in three uplot; do
    printf '\n%s %s\n\n' "$package" "$(node -p "require('./node_modules/$package/package.json').version")"
    cat "node_modules/$package/LICENSE"
  done
} > "$out/licences.txt"
[[ $out == bundle ]] || diff -qr bundle "$out"
