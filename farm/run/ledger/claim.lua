-- Claims a job for an owner, and counts the start.
--
-- A script runs whole: no other client sees a claim between the check and the change.
--
-- KEYS[1]  claims: sorted set of job ids; the score is when the claim lapses, in seconds of the Unix epoch
-- KEYS[2]  owners: hash from job id to the owner of its claim
-- KEYS[3]  starts: hash from job id to the number of its starts
-- ARGV[1]  job id
-- ARGV[2]  owner that claims the job
-- ARGV[3]  seconds until the claim lapses
-- ARGV[4]  owner's name of a job that waits for its next attempt; anyone may take its claim over
-- ARGV[5]  longest time in seconds for which a claim is made; one that lapses later is void: the clock was set back
-- ARGV[6]  seconds for which the keys are kept after this write
-- Returns  the number of this start, from 1; nil if another owner holds a live claim

local time = redis.call('TIME')
local now = time[1] + time[2] / 1e6

local lapses = redis.call('ZSCORE', KEYS[1], ARGV[1])
if lapses and tonumber(lapses) > now and tonumber(lapses) < now + ARGV[5] then
    local owner = redis.call('HGET', KEYS[2], ARGV[1])
    if owner and owner ~= ARGV[2] and owner ~= ARGV[4] then
        return false
    end
end

local start = redis.call('HINCRBY', KEYS[3], ARGV[1], 1)
redis.call('ZADD', KEYS[1], string.format('%.6f', now + ARGV[3]), ARGV[1])
redis.call('HSET', KEYS[2], ARGV[1], ARGV[2])
for _, key in ipairs(KEYS) do
    redis.call('EXPIRE', key, ARGV[6])
end
return start
